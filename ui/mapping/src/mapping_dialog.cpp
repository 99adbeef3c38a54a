// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/mapping/mapping_dialog.h>

#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <algorithm>
#include <cmath>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/import/aligned_recordings.h>
#include <robotlink/import/bridge_sample.h>
#include <robotlink/import/import_session.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/save_file.h>

#include "mapped_field.h"
#include "meaning_tree.h"
#include "offset_strip.h"
#include "topic_tree.h"

namespace pitchboard::ui {
namespace {

constexpr double bridgeSeconds = 2.0;
std::vector<std::string> pathsOf(const QStringList& recordings) {
  std::vector<std::string> paths;
  for (const QString& path : recordings) paths.push_back(path.toStdString());
  return paths;
}

const QString mappingFilter = QStringLiteral("Mappings (*.json);;All files (*)");

}  // namespace

MappingSource mappingSource(const QStringList& recordings) {
  MappingSource source;
  const std::vector<std::string> files = pathsOf(recordings);
  source.name = recordings.size() == 1 ? QFileInfo(QDir::cleanPath(recordings.first())).fileName()
                                       : QStringLiteral("%1 recordings").arg(recordings.size());
  source.prepare = [files](const std::function<bool()>&) -> Result<link::OpenRecordings> {
    using Opened = Result<std::vector<link::OpenedRecording>>;
    return link::OpenRecordings(
        [files](const std::vector<link::MappedRecording>& timing) -> Opened {
          link::TopicMapping mapping;
          mapping.recordings = timing;
          if (files.size() > 1) TRY(link::nameRecordings(files, mapping));
          return link::openTogether(files, mapping.recordings);
        });
  };
  source.file = QString::fromStdString(link::mappingBeside(files.front()));
  source.recordings = recordings;
  return source;
}

MappingSource mappingSource(const telemetry::FoxgloveAddress& bridge, const QString& file) {
  MappingSource source;
  source.name = QString::fromStdString(bridge.text());
  source.prepare = [bridge](const std::function<bool()>& goesOn) {
    return link::listenToBridge(bridge, bridgeSeconds, goesOn);
  };
  source.file = file;
  return source;
}

MappingDialog::~MappingDialog() {
  ++*m_generation;
  m_worker.waitForDone();
}

/// The mapping that was made before, if there is one.
void MappingDialog::readFile() {
  if (m_source.file.isEmpty() || !QFileInfo::exists(m_source.file)) return;
  auto read = link::mappingFromFile(m_source.file.toStdString());
  if (!read) return showProblem(QString::fromStdString(read.error().text()));
  m_mapping = std::move(*read);
  m_isGiven = true;
  nameAll();
}

/// Several recordings are no parts of one, but each its own.
void MappingDialog::nameAll() {
  // If two have the same name, opening them says so.
  if (m_source.recordings.size() > 1) {
    (void)link::nameRecordings(pathsOf(m_source.recordings), m_mapping);
  }
}

void MappingDialog::prepare() {
  m_message->showMessage(InPlaceMessage::Tone::Note,
                         QStringLiteral("Reading %1…").arg(m_source.name));
  ++m_pending;
  m_worker.start([this, prepare = m_source.prepare, generation = m_generation] {
    const int begun = *generation;
    auto opened = prepare([generation, begun] { return *generation == begun; });
    m_toUi.post([this, opened = std::move(opened)] {
      --m_pending;
      if (!opened) return showProblem(QString::fromStdString(opened.error().text()));
      m_open = *opened;
      sample();
    });
  });
}

/// Everything that people change goes through here.
void MappingDialog::change(const std::function<void(link::TopicMapping&)>& how) {
  if (m_isShowing) return;
  link::TopicMapping changed = m_mapping;
  how(changed);
  if (changed == m_mapping) return;
  m_mapping = std::move(changed);
  m_isGiven = true;
  m_message->clear();
  showMapping();
  sample();
}

/// Reads up to the moment of the slider, with the mapping as it is now.
void MappingDialog::sample() {
  if (!m_open) return;
  const int begun = ++*m_generation;
  const auto mapping = m_isGiven ? std::optional(m_mapping) : std::nullopt;
  const bool isAtEnd = m_moment->value() == m_moment->maximum();
  const auto until =
      isAtEnd ? std::nullopt
              : std::optional(m_end * m_moment->value() / static_cast<double>(m_moment->maximum()));
  ++m_pending;
  m_worker.start([this, open = *m_open, mapping, until, begun, generation = m_generation] {
    const auto goesOn = [generation, begun] { return *generation == begun; };
    auto sampled = goesOn() ? link::sampleMapping(open, mapping, until, goesOn)
                            : Result<link::MappingSample>(tl::unexpected(Error{}));
    m_toUi.post([this, sampled = std::move(sampled), begun, generation] {
      --m_pending;
      if (*generation != begun) return;
      if (!sampled) return showProblem(QString::fromStdString(sampled.error().text()));
      showSample(*sampled);
    });
  });
}

void MappingDialog::showSample(const link::MappingSample& sample) {
  if (m_message->text().startsWith(QStringLiteral("Reading "))) m_message->clear();
  m_topics = sample.topics;
  if (m_moment->value() == m_moment->maximum()) {
    m_end = sample.end;
    m_recordings = sample.recordings;
    for (std::size_t i = 0; i < m_recordings.size(); ++i) {
      if (m_recordings[i].timing.file.empty())
        m_recordings[i].timing.file = m_source.name.toStdString();
    }
    showTimes();
  }
  if (!m_isGiven) {
    m_mapping = sample.mapping;
    nameAll();
  }
  m_momentText->setText(QStringLiteral("%1 s").arg(sample.time, 0, 'f', 2));
  m_topicTree->setTopics(m_topics);
  m_field->setSample(sample);
  showMapping();
}

void MappingDialog::showMapping() {
  std::vector<link::TopicFields> topics(m_topics.begin(), m_topics.end());
  const auto problems =
      topics.empty() ? std::vector<link::MappingProblem>() : link::problemsOf(m_mapping, topics);
  m_isShowing = true;
  m_meanings->setMapping(m_mapping, problems);
  m_problems->clear();
  for (const link::MappingProblem& problem : problems) {
    m_problems->addItem(QString::fromStdString(problem.sentence));
  }
  m_problems->setVisible(!problems.empty());
  const bool isUsable = std::ranges::none_of(problems, &link::MappingProblem::isError);
  m_use->setEnabled(isUsable && m_open.has_value());
  m_use->setToolTip(isUsable ? QString()
                             : QStringLiteral("Complete what is named in the list of problems"));
  m_isShowing = false;
  showRobot();
}

void MappingDialog::put(std::size_t robot, link::MappingSlot slot, const link::TopicField& field) {
  const auto topic = std::ranges::find(m_topics, field.topic, [](const link::SampledTopic& one) {
    return std::string_view(one.topic.name);
  });
  const std::span<const telemetry::RecordedField> fields =
      topic == m_topics.end() ? std::span<const telemetry::RecordedField>() : topic->fields;
  std::vector<std::string> cleared;
  change([&](link::TopicMapping& mapping) {
    cleared = link::putField(mapping, robot, slot, field, fields);
  });
  if (cleared.empty()) return;
  QStringList names;
  for (const std::string& name : cleared) names << QString::fromStdString(name);
  m_message->showMessage(
      InPlaceMessage::Tone::Note,
      QStringLiteral("All fields of this part come from one topic, so %1 was cleared.")
          .arg(names.join(QStringLiteral(", "))));
}

void MappingDialog::addRobot() {
  link::MappedRobot robot;
  robot.number = 1;
  const auto isTaken = [&] {
    return std::ranges::any_of(m_mapping.robots, [&](const link::MappedRobot& one) {
      return one.number == robot.number && one.team == robot.team;
    });
  };
  while (robot.number < 99 && isTaken()) ++robot.number;
  change([&](link::TopicMapping& mapping) { mapping.robots.push_back(robot); });
  m_meanings->select(m_mapping.robots.size() - 1);
  m_meanings->setFocus();
}

void MappingDialog::removeRobot() {
  const auto robot = m_meanings->robot();
  if (!robot) return;
  change([&](link::TopicMapping& mapping) {
    mapping.robots.erase(mapping.robots.begin() + static_cast<std::ptrdiff_t>(*robot));
  });
}

/// The entry of a recording in the mapping, which is made with the first change.
link::MappedRecording& MappingDialog::timingOf(link::TopicMapping& mapping,
                                               std::size_t recording) const {
  const std::string& file = m_recordings[recording].timing.file;
  auto known = std::ranges::find(mapping.recordings, file, &link::MappedRecording::file);
  if (known == mapping.recordings.end()) {
    known = mapping.recordings.insert(known, m_recordings[recording].timing);
  }
  return *known;
}

/// Further recordings of the same match: from now on each has its own times.
void MappingDialog::addRecordings() {
  QStringList all = m_source.recordings;
  for (const QString& path : askToOpenSeveral(this, QStringLiteral("Add recordings"))) {
    if (!all.contains(path)) all << path;
  }
  if (all.size() == m_source.recordings.size()) return;
  link::TopicMapping named = m_mapping;
  if (const auto done = link::nameRecordings(pathsOf(all), named); !done) {
    return showProblem(QString::fromStdString(done.error().text()));
  }
  const QString file = m_source.file;
  m_source = mappingSource(all);
  m_source.file = file;
  m_moment->setValue(m_moment->maximum());
  m_open.reset();
  change([&named](link::TopicMapping& mapping) { mapping.recordings = named.recordings; });
  prepare();
}

void MappingDialog::moveRecording(std::size_t recording, double seconds) {
  m_moment->setValue(m_moment->maximum());
  change([&](link::TopicMapping& mapping) {
    double& offset = timingOf(mapping, recording).offset;
    offset = std::round((offset + seconds) * 1000.0) / 1000.0;
    mapping.alignedBy.reset();
  });
}

void MappingDialog::setClock(std::size_t recording, link::RecordingClock clock) {
  m_moment->setValue(m_moment->maximum());
  change([&](link::TopicMapping& mapping) {
    timingOf(mapping, recording).clock = clock;
    mapping.alignedBy.reset();
  });
}

void MappingDialog::alignByTimes() {
  m_moment->setValue(m_moment->maximum());
  change([](link::TopicMapping& mapping) {
    for (link::MappedRecording& recording : mapping.recordings) recording.offset = 0.0;
    mapping.alignedBy.reset();
  });
}

/// Looks for the event in all recordings, in the background.
void MappingDialog::alignByEvent(link::AlignEvent event) {
  m_moment->setValue(m_moment->maximum());
  m_message->showMessage(InPlaceMessage::Tone::Note,
                         QStringLiteral("Reading the states of the game…"));
  const int begun = ++*m_generation;
  ++m_pending;
  m_worker.start([this, event, mapping = m_mapping, files = pathsOf(m_source.recordings), begun,
                  generation = m_generation]() mutable {
    Result<void> done = link::nameRecordings(files, mapping);
    if (done) {
      done = link::alignRecordings(files, event, mapping, [&] { return *generation == begun; });
    }
    m_toUi.post([this, done, mapping = std::move(mapping), begun, generation] {
      --m_pending;
      if (*generation != begun) return;
      m_message->clear();
      if (!done) showProblem(QString::fromStdString(done.error().text()));
      const bool isChanged = done && mapping != m_mapping;
      if (isChanged) change([&mapping](link::TopicMapping& changed) { changed = mapping; });
      if (!isChanged) sample();  // this one has stopped another
      showAlignment();
    });
  });
}

bool MappingDialog::save(const QString& file) {
  const std::string text = link::mappingText(m_mapping);
  QSaveFile target(file);
  const bool isWritten = target.open(QIODevice::WriteOnly) &&
                         target.write(text.data(), static_cast<qint64>(text.size())) ==
                             static_cast<qint64>(text.size());
  if (!isWritten || !commitWhole(target)) {
    showProblem(QStringLiteral("Cannot write %1: %2. Choose another place with Save as….")
                    .arg(file, target.errorString()));
    return false;
  }
  m_source.file = file;
  return true;
}

void MappingDialog::openMapping() {
  const QString file = askToOpen(this, QStringLiteral("Open mapping"), mappingFilter);
  if (file.isEmpty()) return;
  auto read = link::mappingFromFile(file.toStdString());
  if (!read) return showProblem(QString::fromStdString(read.error().text()));
  change([&](link::TopicMapping& mapping) { mapping = *read; });
}

void MappingDialog::saveAs() {
  const QString name = m_source.file.isEmpty() ? QStringLiteral("mapping.json")
                                               : QFileInfo(m_source.file).fileName();
  const QString file = askToSave(this, QStringLiteral("Save mapping"), name, mappingFilter);
  if (!file.isEmpty()) save(file);
}

void MappingDialog::use() {
  if (m_source.file.isEmpty()) saveAs();
  if (m_source.file.isEmpty() || !save(m_source.file)) return;
  emit used(m_source.file, m_source.recordings);
  accept();
}

void MappingDialog::showProblem(const QString& sentence) {
  m_message->showMessage(InPlaceMessage::Tone::Error, sentence);
}

}  // namespace pitchboard::ui
