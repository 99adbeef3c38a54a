// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/session/export_dialog.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDateTimeEdit>
#include <QDesktopServices>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUrl>
#include <algorithm>

#include <base/file_target.h>
#include <ui/base/dialog_size.h>
#include <ui/base/file_dialog.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/sources/field_pictures.h>

#include <ui/session/video_export.h>
#include "check_list.h"
#include "moment_box.h"

namespace pitchboard::ui {
namespace {

QStringList groupNames(const ExportSource& source) {
  QStringList names;
  for (const auto& group : source.groups) names << QString::fromStdString(group.name);
  names.removeDuplicates();
  return names;
}

QStringList variableNames(const ExportSource& source) {
  QStringList names;
  for (const auto& group : source.groups) {
    for (const auto& column : group.columns) names << QString::fromStdString(column.name);
  }
  names.removeDuplicates();
  return names;
}

}  // namespace

ExportDialog::ExportDialog(ExportSource source, telemetry::TimeRange range,
                           const FieldPictures* pictures, QWidget* parent)
    : QDialog(parent),
      m_source(std::move(source)),
      m_pictures(pictures),
      m_format(new QComboBox(this)),
      m_begin(new MomentBox(this)),
      m_end(new MomentBox(this)),
      m_when(new QWidget(this)),
      m_beginClock(new QDateTimeEdit(m_when)),
      m_endClock(new QDateTimeEdit(m_when)),
      m_robots(new CheckList(groupNames(m_source), QStringLiteral("Filter, e.g. B1"), this)),
      m_variables(
          new CheckList(variableNames(m_source), QStringLiteral("Filter, e.g. VISION"), this)),
      m_lines(new NumberBox(this)),
      m_between(new QComboBox(this)),
      m_clock(new QCheckBox(QStringLiteral("Time of day beside each time"), this)),
      m_size(new QComboBox(this)),
      m_rate(new QSpinBox(this)),
      m_cameras(new QCheckBox(QStringLiteral("Cameras of the panel Video"), this)),
      m_curves(new QCheckBox(QStringLiteral("Plots as they are shown"), this)),
      m_rows(new QFormLayout),
      m_progress(new QProgressBar(this)),
      m_message(new QLabel(this)),
      m_open(new QToolButton(this)),
      m_show(new QToolButton(this)) {
  setWindowTitle(QStringLiteral("Export"));
  setObjectName(QStringLiteral("exportDialog"));
  m_format->setObjectName(QStringLiteral("exportFormat"));
  m_robots->setObjectName(QStringLiteral("exportRobots"));
  m_variables->setObjectName(QStringLiteral("exportVariables"));
  m_message->setObjectName(QStringLiteral("exportMessage"));
  m_size->setObjectName(QStringLiteral("exportSize"));
  m_begin->setObjectName(QStringLiteral("exportBegin"));
  m_end->setObjectName(QStringLiteral("exportEnd"));
  m_cameras->setObjectName(QStringLiteral("exportCameras"));
  m_curves->setObjectName(QStringLiteral("exportCurves"));
  m_rate->setObjectName(QStringLiteral("exportRate"));
  m_progress->setObjectName(QStringLiteral("exportProgress"));
  for (const ExportForm& form : exportForms()) m_format->addItem(QString::fromUtf8(form.title));
  for (const QSize size :
       {QSize(1280, 720), QSize(1920, 1080), QSize(640, 360), QSize(3840, 2160)}) {
    const QSize made = m_pictures != nullptr ? m_pictures->pictureSize(size) : size;
    m_size->addItem(QStringLiteral("%1 × %2").arg(made.width()).arg(made.height()), size);
  }
  m_size->setToolTip(QStringLiteral(
      "The picture has the shape of the field, unless something is shown beside it."));
  m_rate->setRange(1, 60);
  m_rate->setValue(30);
  m_rate->setSuffix(QStringLiteral(" frames per second"));
  m_begin->setMoment(range.begin);
  m_end->setMoment(range.end);
  makeChoices();
  m_message->setWordWrap(true);
  m_message->setForegroundRole(QPalette::PlaceholderText);
  m_progress->setRange(0, 1000);
  m_progress->setFormat(QStringLiteral("%p %"));
  m_progress->hide();
  m_rows->addRow(QStringLiteral("Format"), m_format);
  m_rows->addRow(QStringLiteral("From"), m_begin);
  m_rows->addRow(QStringLiteral("To"), m_end);
  m_rows->addRow(QStringLiteral("Time of day"), m_when);
  m_rows->addRow(QStringLiteral("Robots"), m_robots);
  m_rows->addRow(QStringLiteral("Variables"), m_variables);
  m_rows->addRow(QStringLiteral("Lines"), m_lines);
  m_rows->addRow(QStringLiteral("Between rows"), m_between);
  m_rows->addRow(QString(), m_clock);
  m_rows->addRow(QStringLiteral("Size"), m_size);
  m_rows->addRow(QStringLiteral("Rate"), m_rate);
  m_rows->addRow(QStringLiteral("Beside the field"), m_cameras);
  m_rows->addRow(QString(), m_curves);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_export = buttons->addButton(QStringLiteral("Export…"), QDialogButtonBox::ActionRole);
  m_export->setObjectName(QStringLiteral("exportButton"));
  auto* column = new QVBoxLayout(this);
  column->addLayout(m_rows);
  column->addWidget(m_progress);
  column->addWidget(m_message);
  auto* after = new QHBoxLayout;
  after->addWidget(m_open);
  after->addWidget(m_show);
  after->addStretch(1);
  column->addLayout(after);
  column->addWidget(buttons);
  resize(dialogSize(this, 420, 100));
  connect(m_format, &QComboBox::currentIndexChanged, this, &ExportDialog::showRows);
  showRows();
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_export, &QPushButton::clicked, this, [this] {
    if (m_writing)
      cancel();
    else
      ask();
  });
}

ExportDialog::~ExportDialog() {
  m_cancelled = true;
  m_worker.waitForDone();
}

const ExportForm& ExportDialog::form() const {
  return exportForms()[static_cast<std::size_t>(m_format->currentIndex())];
}

QString ExportDialog::suffix() const {
  return QLatin1String(form().suffix);
}

// Only what the chosen form asks for.
void ExportDialog::showRows() {
  const ExportKind kind = form().kind;
  const bool picture = kind == ExportKind::Png || kind == ExportKind::Svg;
  for (QWidget* row : {m_begin, m_end}) m_rows->setRowVisible(row, !picture);
  const bool numbers = kind == ExportKind::Numbers;
  const bool table = numbers && form().format != telemetry::ExportFormat::Mcap &&
                     form().format != telemetry::ExportFormat::JsonLines;
  const bool even = numbers && form().format == telemetry::ExportFormat::CsvEven;
  m_rows->setRowVisible(m_when, !picture && m_source.clock.has_value());
  m_rows->setRowVisible(m_robots, !picture && !m_robots->isEmpty());
  m_rows->setRowVisible(m_variables, numbers && !m_variables->isEmpty());
  m_rows->setRowVisible(m_lines, even);
  m_rows->setRowVisible(m_between, even);
  m_rows->setRowVisible(m_clock, table && m_source.clock.has_value());
  m_rows->setRowVisible(m_size, picture || kind == ExportKind::Video);
  m_rows->setRowVisible(m_rate, kind == ExportKind::Video);
  m_rows->setRowVisible(m_cameras, kind == ExportKind::Video && !m_source.film.cameras.empty());
  m_rows->setRowVisible(m_curves,
                        kind == ExportKind::Video && !m_source.film.curves.picture.isNull());
  // As high as its rows.
  layout()->activate();
  resize(width(), std::min(dialogSize(this, 420, 4000).height(),
                           std::max(sizeHint().height(), layout()->heightForWidth(width()))));
}

QByteArray ExportDialog::picture() const {
  switch (form().kind) {
    case ExportKind::Png:
    case ExportKind::Svg:
      return m_pictures->pictureFile(m_size->currentData().toSize(),
                                     suffix().mid(1));  // without its dot
    case ExportKind::Report:
      return m_pictures->pictureFile({1040, 740}, QStringLiteral("png"));
    default:
      return {};
  }
}

void ExportDialog::ask() {
  const QByteArray now = picture();  // the match goes on behind the dialog
  QString path = askToSave(this, QStringLiteral("Export"), m_source.name + suffix());
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += suffix();
  begin(path, now);
}

void ExportDialog::exportTo(const QString& path) {
  begin(path, picture());
}

void ExportDialog::begin(const QString& path, const QByteArray& picture) {
  if (m_writing) return;
  m_cancelled = false;
  m_picture = picture;
  const ExportForm& chosen = form();
  if (chosen.kind == ExportKind::Png || chosen.kind == ExportKind::Svg) {
    writePicture(path);
    return;
  }
  ExportRequest request;
  request.session = m_source.session;
  request.path = path;
  request.selection.range = {m_begin->moment(), m_end->moment()};
  if (!takeChoices(request.selection)) return;
  if (request.selection.range.begin > request.selection.range.end) {
    fail(QStringLiteral("The range ends before it begins."));
    return;
  }
  setWriting(true);
  if (!request.session.isEmpty()) {
    write(request);
    return;
  }
  // From memory: what is there now is written to a session that is gone with the dialog.
  m_memory = std::make_unique<QTemporaryDir>();
  request.session = m_memory->filePath(QStringLiteral("memory.mcap"));
  SessionMaker make = m_source.make ? m_source.make() : SessionMaker();
  if (!make) {
    setWriting(false);
    fail(QStringLiteral("There is nothing in memory to export yet."));
    return;
  }
  m_worker.start([this, request, make = std::move(make)] {
    const auto made = make(request.session);
    m_toUi.post([this, made, request] {
      if (made && !m_cancelled) {
        write(request);
        return;
      }
      setWriting(false);
      fail(m_cancelled ? QStringLiteral("Export cancelled.")
                       : QStringLiteral("Export failed: %1")
                             .arg(QString::fromStdString(made.error().text())));
    });
  });
}

void ExportDialog::write(const ExportRequest& request) {
  if (form().kind == ExportKind::Video) {
    writeVideo(request);
    return;
  }
  m_worker.start([this, request, chosen = form(), picture = m_picture] {
    const auto done = writeExport(request, chosen, picture, [this](double part) {
      m_toUi.post([this, part] { m_progress->setValue(static_cast<int>(part * 1000)); });
      return !m_cancelled;
    });
    m_toUi.post([this, done, path = request.path] {
      setWriting(false);
      if (done) {
        succeed(path);
      } else {
        fail(m_cancelled ? QStringLiteral("Export cancelled.")
                         : QStringLiteral("Export failed: %1")
                               .arg(QString::fromStdString(done.error().text())));
      }
    });
  });
}

void ExportDialog::writeVideo(const ExportRequest& request) {
  m_video = std::make_unique<VideoExport>(m_pictures->framePainter(), nullptr);
  connect(m_video.get(), &VideoExport::progressed, this,
          [this](double part) { m_progress->setValue(static_cast<int>(part * 1000)); });
  connect(m_video.get(), &VideoExport::finished, this, [this](const QString& path) {
    setWriting(false);
    succeed(path);
  });
  connect(m_video.get(), &VideoExport::failed, this, [this](const QString& sentence) {
    setWriting(false);
    fail(sentence);
  });
  VideoOptions options;
  options.path = request.path;
  FilmParts parts;
  if (m_cameras->isChecked()) parts.cameras = m_source.film.cameras;
  if (m_curves->isChecked()) parts.curves = m_source.film.curves;
  options.size = m_size->currentData().toSize();
  if (parts.isEmpty()) options.size = m_pictures->pictureSize(options.size);
  options.framesPerSecond = m_rate->value();
  options.overwrite = true;
  const auto range = request.selection.range;
  if (const auto started = m_video->start(request.session, {range.begin, range.end},
                                          request.selection.robots, options, std::move(parts));
      !started) {
    setWriting(false);
    fail(QString::fromStdString(started.error().text()));
  }
}

void ExportDialog::writePicture(const QString& path) {
  const auto written = writeFile(
      path.toStdString(), {m_picture.constData(), static_cast<std::size_t>(m_picture.size())},
      IfExists::Replace, m_source.session.toStdString());
  if (!written) {
    fail(QStringLiteral("Export failed: %1").arg(QString::fromStdString(written.error().text())));
    return;
  }
  succeed(path);
}

void ExportDialog::cancel() {
  m_cancelled = true;
  if (!m_video) return;
  m_video.reset();
  setWriting(false);
  fail(QStringLiteral("Export cancelled."));
}

void ExportDialog::succeed(const QString& path) {
  showStatus(QStringLiteral("Exported to %1 (%2 MB)")
                 .arg(path)
                 .arg(static_cast<double>(QFileInfo(path).size()) / 1e6, 0, 'f', 1),
             false);
  m_written = path;
  for (QToolButton* button : {m_open, m_show}) button->show();
  emit written(path);
}

void ExportDialog::fail(const QString& sentence) {
  showStatus(sentence, !m_cancelled);
  emit failed(sentence);
}

void ExportDialog::setWriting(bool writing) {
  m_writing = writing;
  for (QToolButton* button : {m_open, m_show}) button->hide();
  // What asks for it may be the video itself.
  if (!writing && m_video) m_video.release()->deleteLater();
  m_progress->setVisible(writing);
  m_progress->setValue(0);
  m_export->setText(writing ? QStringLiteral("Cancel") : QStringLiteral("Export…"));
  for (QWidget* choice : {static_cast<QWidget*>(m_format), static_cast<QWidget*>(m_size)}) {
    choice->setEnabled(!writing);
  }
  if (writing) showStatus({}, false);
}

void ExportDialog::showStatus(const QString& text, bool error) {
  QPalette colours = palette();
  if (error) colours.setColor(QPalette::PlaceholderText, theme().errorText);
  m_message->setPalette(colours);
  m_message->setText(text);
}

namespace {

std::vector<std::string> textsOf(const QStringList& names) {
  std::vector<std::string> texts;
  for (const QString& name : names) texts.push_back(name.toStdString());
  return texts;
}

}  // namespace

void ExportDialog::makeChoices() {
  m_lines->setObjectName(QStringLiteral("exportLines"));
  m_lines->setRange(0.001, telemetry::Resampling::maxPerSecond);
  m_lines->setDecimals(3);
  m_lines->setValue(telemetry::Resampling{}.rate);
  m_lines->setSuffix(QStringLiteral(" per second"));
  m_between->setObjectName(QStringLiteral("exportBetween"));
  m_between->addItem(QStringLiteral("Hold the last value"), false);
  m_between->addItem(QStringLiteral("Interpolate"), true);
  m_clock->setObjectName(QStringLiteral("exportClock"));
  m_clock->setChecked(m_source.clock.has_value());
  auto* times = new QHBoxLayout(m_when);
  times->setContentsMargins(0, 0, 0, 0);
  times->addWidget(m_beginClock, 1);
  times->addWidget(new QLabel(QStringLiteral("to"), m_when));
  times->addWidget(m_endClock, 1);
  m_beginClock->setObjectName(QStringLiteral("exportBeginClock"));
  m_endClock->setObjectName(QStringLiteral("exportEndClock"));
  const std::pair<QDateTimeEdit*, MomentBox*> pairs[] = {{m_beginClock, m_begin},
                                                         {m_endClock, m_end}};
  for (const auto& [clock, box] : pairs) {
    clock->setDisplayFormat(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
    connect(clock, &QDateTimeEdit::dateTimeChanged, this,
            [this, seconds = box](const QDateTime& time) {
              // A change of the seconds comes back here rounded.
              if (!m_source.clock || m_showingClock) return;
              seconds->setValue(static_cast<double>(m_source.clock->msecsTo(time)) / 1000.0);
            });
  }
  m_open->setText(QStringLiteral("Open"));
  m_open->setObjectName(QStringLiteral("exportOpen"));
  m_show->setText(QStringLiteral("Show in folder"));
  m_show->setObjectName(QStringLiteral("exportShow"));
  for (QToolButton* button : {m_open, m_show}) button->hide();
  connect(m_open, &QToolButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(m_written)); });
  connect(m_show, &QToolButton::clicked, this, [this] {
    QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(m_written).absolutePath()));
  });
  for (MomentBox* box : {m_begin, m_end}) {
    connect(box, &MomentBox::valueChanged, this, &ExportDialog::showClock);
  }
  showClock();
}

// People think in the time of day; a session counts seconds. Either can be typed.
void ExportDialog::showClock() {
  if (!m_source.clock) return;
  m_showingClock = true;
  m_beginClock->setDateTime(m_source.clock->addMSecs(qRound64(m_begin->value() * 1000.0)));
  m_endClock->setDateTime(m_source.clock->addMSecs(qRound64(m_end->value() * 1000.0)));
  m_showingClock = false;
}

/// False: it has said what is missing.
bool ExportDialog::takeChoices(telemetry::ExportSelection& selection) {
  const bool numbers = form().kind == ExportKind::Numbers;
  const QStringList robots = m_robots->checked(), variables = m_variables->checked();
  if (m_source.groups.empty()) return true;  // nothing to choose from yet: everything
  if (robots.isEmpty() || (numbers && variables.isEmpty())) {
    fail(robots.isEmpty() ? QStringLiteral("Select at least one robot.")
                          : QStringLiteral("Select at least one variable."));
    return false;
  }
  if (!m_robots->isAllChecked()) selection.robots = textsOf(robots);
  if (!numbers) return true;
  if (!m_variables->isAllChecked()) {
    // The variables of the ticked robots.
    QStringList known;
    for (const auto& group : m_source.groups) {
      if (!robots.contains(QString::fromStdString(group.name))) continue;
      for (const auto& column : group.columns) known << QString::fromStdString(column.name);
    }
    for (const QString& name : variables) {
      if (known.contains(name)) selection.variables.push_back(name.toStdString());
    }
    if (selection.variables.empty()) {
      fail(QStringLiteral("The selected robots have none of the selected variables."));
      return false;
    }
  }
  selection.clock = m_clock->isChecked();
  selection.resampling = {m_lines->value(), m_between->currentData().toBool()};
  return true;
}

}  // namespace pitchboard::ui
