// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>

#include <robotlink/report.h>
#include <ui/theme.h>

namespace pitchboard::ui {
namespace {

using telemetry::ExportFormat;

struct Form {
  const char* words;
  std::optional<ExportFormat> format;   ///< nothing: the report
};
const Form forms[] = {
    {QT_TRANSLATE_NOOP("ExportDialog", "Table, a row per time (CSV)"), ExportFormat::CsvWide},
    {QT_TRANSLATE_NOOP("ExportDialog", "Table, a row per value (CSV)"), ExportFormat::CsvLong},
    {QT_TRANSLATE_NOOP("ExportDialog", "JSON lines"), ExportFormat::JsonLines},
    {QT_TRANSLATE_NOOP("ExportDialog", "Shorter session (MCAP)"), ExportFormat::Mcap},
    {QT_TRANSLATE_NOOP("ExportDialog", "Report (HTML)"), std::nullopt},
};

std::vector<std::string> namesOf(const QString& text) {
  static const QRegularExpression between(QStringLiteral("[\\s,;]+"));
  std::vector<std::string> names;
  for (const QString& name : text.split(between, Qt::SkipEmptyParts)) {
    names.push_back(name.toStdString());
  }
  return names;
}

Result<std::uint64_t> writeReport(const telemetry::SessionReader& session,
                                  const ExportRequest& request, const QByteArray& picture) {
  const telemetry::SessionRange range = request.selection.range;
  link::ReportContent content;
  content.session = session.info();
  content.title = content.session.title;
  content.statistics = link::statisticsOf(session, {range.begin, range.end});
  for (telemetry::SessionEvent& event : session.events()) {
    if (event.time >= range.begin && event.time <= range.end) content.events.push_back(event);
  }
  content.picture = picture.toStdString();
  content.notes = session.notes();
  const auto done = link::writeReport(request.path.toStdString(), content);
  if (!done) return tl::unexpected(done.error());
  return static_cast<std::uint64_t>(QFileInfo(request.path).size());
}

Result<std::uint64_t> write(const ExportRequest& request, std::optional<ExportFormat> format,
                            const QByteArray& picture,
                            const telemetry::ExportProgress& progress) {
  const auto session = telemetry::SessionReader::open(request.session.toStdString());
  if (!session) return tl::unexpected(session.error());
  if (!format) return writeReport(*session, request, picture);
  const auto report = telemetry::exportFile(*session, *format, request.selection,
                                            request.path.toStdString(), progress);
  if (!report) return tl::unexpected(report.error());
  return report->bytes;
}

}  // namespace

ExportDialog::ExportDialog(const QString& session, telemetry::TimeRange range, QByteArray picture,
                           QWidget* parent)
    : QDialog(parent), m_session(session), m_picture(std::move(picture)),
      m_format(new QComboBox(this)), m_begin(new QDoubleSpinBox(this)),
      m_end(new QDoubleSpinBox(this)), m_robots(new QLineEdit(this)),
      m_variables(new QLineEdit(this)), m_progress(new QProgressBar(this)),
      m_message(new QLabel(this)) {
  setWindowTitle(tr("Export"));
  setObjectName(QStringLiteral("exportDialog"));
  m_format->setObjectName(QStringLiteral("exportFormat"));
  m_robots->setObjectName(QStringLiteral("exportRobots"));
  m_variables->setObjectName(QStringLiteral("exportVariables"));
  m_message->setObjectName(QStringLiteral("exportMessage"));
  for (const Form& form : forms) m_format->addItem(tr(form.words));
  for (QDoubleSpinBox* box : {m_begin, m_end}) {
    box->setRange(-1e7, 1e7);
    box->setDecimals(3);
    box->setSuffix(tr(" s"));
  }
  m_begin->setValue(range.begin);
  m_end->setValue(range.end);
  m_robots->setPlaceholderText(tr("all, or e.g. B1 R2 match"));
  m_variables->setPlaceholderText(tr("all, or e.g. VISION_* LOCALIZATION_X"));
  m_message->setWordWrap(true);
  m_message->setForegroundRole(QPalette::PlaceholderText);
  m_progress->setRange(0, 1000);
  m_progress->hide();
  auto* rows = new QFormLayout;
  rows->addRow(tr("Form"), m_format);
  rows->addRow(tr("From"), m_begin);
  rows->addRow(tr("To"), m_end);
  rows->addRow(tr("Robots"), m_robots);
  rows->addRow(tr("Variables"), m_variables);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_export = buttons->addButton(tr("Export…"), QDialogButtonBox::ActionRole);
  m_export->setObjectName(QStringLiteral("exportButton"));
  auto* column = new QVBoxLayout(this);
  column->addLayout(rows);
  column->addWidget(m_progress);
  column->addWidget(m_message);
  column->addWidget(buttons);
  resize(scaled(this, 420), sizeHint().height());
  m_worker.setMaxThreadCount(1);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_export, &QPushButton::clicked, this, [this] {
    if (m_writing) cancel();
    else ask();
  });
}

ExportDialog::~ExportDialog() {
  m_cancelled = true;
  m_worker.waitForDone();
}

QString ExportDialog::suffix() const {
  const auto& format = forms[m_format->currentIndex()].format;
  if (!format) return QStringLiteral(".html");
  const std::string_view ending = telemetry::fileExtension(*format);
  return QString::fromUtf8(ending.data(), static_cast<qsizetype>(ending.size()));
}

void ExportDialog::ask() {
  const QFileInfo from(m_session);
  QString path = QFileDialog::getSaveFileName(
      this, tr("Export"), from.dir().filePath(from.completeBaseName() + tr(" part") + suffix()));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += suffix();
  // The file dialog has asked whether the old one is to go.
  QFile::remove(path);
  exportTo(path);
}

void ExportDialog::exportTo(const QString& path) {
  if (m_writing) return;
  ExportRequest request;
  request.session = m_session;
  request.path = path;
  request.selection.range = {m_begin->value(), m_end->value()};
  request.selection.robots = namesOf(m_robots->text());
  request.selection.variables = namesOf(m_variables->text());
  if (request.selection.range.begin > request.selection.range.end) {
    tell(tr("The range ends before it begins."), true);
    emit failed(m_message->text());
    return;
  }
  m_cancelled = false;
  setWriting(true);
  m_worker.start([this, request, format = forms[m_format->currentIndex()].format,
                  picture = m_picture] {
    const auto done = write(request, format, picture, [this](double part) {
      QMetaObject::invokeMethod(this, [this, part] {
        m_progress->setValue(static_cast<int>(part * 1000));
      }, Qt::QueuedConnection);
      return !m_cancelled;
    });
    QMetaObject::invokeMethod(this, [this, done, path = request.path] {
      setWriting(false);
      if (done) {
        tell(tr("Written: %1 (%2 MB)").arg(path).arg(static_cast<double>(*done) / 1e6, 0, 'f', 1),
             false);
        emit written(path);
        return;
      }
      tell(m_cancelled ? tr("Cancelled; nothing was written.")
                       : tr("Nothing was written: %1")
                             .arg(QString::fromStdString(done.error().text())),
           !m_cancelled);
      emit failed(m_message->text());
    }, Qt::QueuedConnection);
  });
}

void ExportDialog::cancel() { m_cancelled = true; }

void ExportDialog::setWriting(bool writing) {
  m_writing = writing;
  m_progress->setVisible(writing);
  m_progress->setValue(0);
  m_export->setText(writing ? tr("Cancel") : tr("Export…"));
  if (writing) tell({}, false);
}

void ExportDialog::tell(const QString& text, bool error) {
  QPalette colours = palette();
  if (error) colours.setColor(QPalette::PlaceholderText, theme().errorText);
  m_message->setPalette(colours);
  m_message->setText(text);
}

}  // namespace pitchboard::ui
