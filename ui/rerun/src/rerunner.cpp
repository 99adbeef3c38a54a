// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/rerun/rerunner.h>

#include <QDir>
#include <QFileInfo>
#include <utility>

#include <base/file_target.h>
#include <robotlink/rerun/rerun_text.h>
#include <telemetry/session/session_reader.h>
#include <ui/base/cache_folder.h>
#include <ui/base/plot_target.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

constexpr int lookMilliseconds = 200;
const QString rerunSuffix = QStringLiteral(" rerun");

/// Without names of options, which nobody typed here.
QString rerunErrorText(const Error& error) {
  return QString::fromStdString(error.context.starts_with("--") ? error.message : error.text());
}

}  // namespace

Rerunner::Rerunner(const Parts& parts, QObject* parent) : QObject(parent), m_parts(parts) {
  m_look.setInterval(lookMilliseconds);
  connect(&m_look, &QTimer::timeout, this, &Rerunner::look);
  connect(parts.replay, &ReplayController::restarted, this, &Rerunner::forget);
  connect(parts.replay, &ReplayController::opened, this, &Rerunner::showResult);
  connect(parts.replay, &ReplayController::rowsCame, this, &Rerunner::plotOver);
  connect(parts.shown, &ShownMoment::sourceChosen, this, [this] {
    showPending();
    emit changed();
  });
}

Rerunner::~Rerunner() {
  cancel();
}

QString Rerunner::whyNot() const {
  if (m_parts.shown->source() != m_parts.replay) return QStringLiteral("Only in Replay");
  if (!m_parts.replay->isOpen()) return QStringLiteral("Open a recording first");
  return robots().empty() ? QStringLiteral("This recording has no blackboard variables of a robot")
                          : QString();
}

std::vector<std::pair<QString, QStringList>> Rerunner::robots() const {
  std::vector<std::pair<QString, QStringList>> all;
  for (const telemetry::GroupInfo& group : m_parts.replay->groups()) {
    if (!group.robot || group.match) continue;
    const QString name = QString::fromStdString(group.name);
    // What a rerun has added to the recording is not in it.
    const bool isAdded = m_parts.replay->recording() != m_parts.replay->path() && m_result &&
                         name == QString::fromStdString(m_result->robot) + rerunSuffix;
    QStringList processes;
    for (const std::string& process : link::recordedProcesses(group)) {
      processes << QString::fromStdString(process);
    }
    if (!isAdded && !processes.isEmpty()) all.emplace_back(name, processes);
  }
  return all;
}

QString Rerunner::recording() const {
  return m_parts.replay->recording();
}

void Rerunner::start(const RerunOrder& order) {
  m_order = order;
  m_orderOf = recording();
  if (m_watch) setFollowing(true);  // another program
  run(false);
}

void Rerunner::again() {
  if (!canRunAgain()) return;
  m_order->unchanged.clear();  // it has been checked
  run(true);
}

void Rerunner::run(bool again) {
  cancel();
  m_problem.clear();
  m_progress = 0.0;
  m_checking = !m_order->unchanged.empty();
  if (!m_folder) m_folder = makeCacheFolder(QStringLiteral("rerun"));
  const QDir folder(m_folder->filePath(QString::number(++m_count)));
  QDir().mkpath(folder.path());
  const QString to = folder.filePath(QFileInfo(m_orderOf).completeBaseName() + rerunSuffix +
                                     QStringLiteral(".mcap"));
  m_running = std::make_shared<std::atomic<bool>>(false);
  RerunOrder order = *m_order;
  order.options.robotProgram = m_robotProgram;
  order.options.last = again && m_result ? m_result->outputs : nullptr;
  m_worker.start([this, order = std::move(order), session = m_orderOf.toStdString(),
                  to = to.toStdString(), cancelled = m_running] {
    Made made = *cancelled ? Made{} : make(session, order, to, cancelled);
    m_ui.post([this, made = std::move(made), cancelled] {
      if (cancelled == m_running) take(made);
    });
  });
  emit changed();
}

/// On the worker.
Rerunner::Made Rerunner::make(const std::string& path, RerunOrder order, const std::string& to,
                              const std::shared_ptr<std::atomic<bool>>& cancelled) {
  Made made;
  const auto failed = [&made](const Error& error) {
    made.problem = rerunErrorText(error);
    return made;
  };
  const auto session = telemetry::SessionReader::open(path);
  if (!session) return failed(session.error());
  int shown = -1;
  order.options.progress = [&](double part) {
    const int percent = static_cast<int>(part * 100.0);
    if (std::exchange(shown, percent) != percent) {
      m_ui.post([this, part, cancelled] {
        if (cancelled != m_running) return;
        m_progress = part;
        emit changed();
      });
    }
    return !*cancelled;
  };
  if (!order.unchanged.empty()) {
    link::RerunOptions same = order.options;
    same.processes = order.unchanged;
    same.unchanged.clear();
    same.isUnchanged = true;
    const auto found = link::rerun(*session, same);
    if (!found) return failed(found.error());
    const auto kept = link::keepUnchanged(path, order.options, *found);
    if (!kept) made.problem = rerunErrorText(kept.error());
    for (const link::ComparedVariable& one : found->variables) {
      if (one.differs()) order.options.unchanged.push_back(one);
    }
    made.unchanged = order.options.unchanged;
    m_ui.post([this, cancelled] {
      if (cancelled != m_running) return;
      m_checking = false;
      m_progress = 0.0;
      emit changed();
    });
  } else if (order.options.unchanged.empty()) {
    auto known = link::readUnchanged(path, order.options);
    if (!known) return failed(known.error());
    order.options.unchanged = std::move(*known);
  }
  auto result = link::rerunToFile(*session, order.options, to, IfExists::Replace);
  if (!result) return failed(result.error());
  made.result = std::make_shared<const link::RerunResult>(std::move(*result));
  made.path = QString::fromStdString(to);
  return made;
}

void Rerunner::take(const Made& made) {
  m_running.reset();
  m_checking = false;
  m_problem = made.problem;
  if (!made.unchanged.empty() && m_order) m_order->options.unchanged = made.unchanged;
  if (!made.result) {
    emit changed();
    return;
  }
  m_result = made.result;
  m_pending = made.path;
  showPending();
  emit changed();
  emit finished();
}

/// In Replay only: nobody is taken away from what he is looking at.
void Rerunner::showPending() {
  if (m_pending.isEmpty() || m_parts.shown->source() != m_parts.replay) return;
  const ShownMoment& shown = *m_parts.shown;
  m_place = {shown.time(), shown.selection(),
             m_parts.time->isFollowing() ? std::nullopt : std::optional(m_parts.time->range())};
  m_showing = std::exchange(m_pending, QString());
  m_parts.replay->open(m_showing, m_orderOf);
}

void Rerunner::showResult() {
  if (m_showing.isEmpty() || m_parts.replay->path() != m_showing) return;
  const QString before = std::exchange(m_file, std::exchange(m_showing, QString()));
  if (!before.isEmpty()) QDir(QFileInfo(before).path()).removeRecursively();
  m_parts.shown->seek(m_place.time);
  m_parts.shown->setSelection(m_place.selection);
  if (m_place.range) m_parts.time->setRange(*m_place.range);
  plotOver();
}

void Rerunner::plotOver() {
  if (!m_result || m_parts.replay->path() == m_parts.replay->recording()) return;
  QStringList columns;
  for (const link::ComparedVariable& one : m_result->variables) {
    columns << QString::fromStdString(one.column.name);
  }
  const QString robot = QString::fromStdString(m_result->robot);
  m_parts.plots->plotOver(robot, robot + rerunSuffix, columns);
}

void Rerunner::plot(const QString& variable) {
  if (!m_result) return;
  const QString robot = QString::fromStdString(m_result->robot);
  m_parts.plots->plotVariables(
      {robot + QLatin1Char('/') + variable, robot + rerunSuffix + QLatin1Char('/') + variable});
}

/// Another recording has nothing to do with what ran before.
void Rerunner::forget() {
  if (m_orderOf == recording()) {
    emit changed();
    return;
  }
  cancel();
  m_order.reset();
  m_orderOf.clear();
  m_result.reset();
  m_problem.clear();
  m_pending.clear();
  setFollowing(false);
  emit changed();
}

void Rerunner::cancel() {
  if (!m_running) return;
  *m_running = true;
  m_running.reset();
  m_checking = false;
  emit changed();
}

QString Rerunner::whyNotFollow() const {
  if (!m_order) return QStringLiteral("Nothing has run yet");
  return link::programFiles(m_order->options.processes).empty()
             ? QStringLiteral("Our processes do not change while Pitchboard runs")
             : QString();
}

void Rerunner::setFollowing(bool on) {
  on = on && m_order && whyNotFollow().isEmpty();
  m_watch.reset();
  if (on) m_watch.emplace(m_order->options.processes);
  on ? m_look.start() : m_look.stop();
  emit changed();
}

void Rerunner::look() {
  if (isRunning() || !canRunAgain()) return;
  if (m_watch && m_watch->hasChanged(std::chrono::steady_clock::now())) again();
}

Result<void> Rerunner::writeReport(const QString& path) const {
  return writeFile(path.toStdString(),
                   link::rerunReport(*m_result, QFileInfo(m_orderOf).fileName().toStdString()),
                   IfExists::Replace);
}

}  // namespace pitchboard::ui
