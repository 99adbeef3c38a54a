// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/calibrate/calibrate_dialog.h>

#include <QComboBox>
#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QTabWidget>
#include <QTableWidget>

#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/calibrate/calibration_file.h>
#include <robotlink/models/robot_models.h>
#include <simcore/simulation/simulation.h>
#include <telemetry/session/session_reader.h>
#include <ui/base/dialog_size.h>
#include <ui/base/file_dialog.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "calibration_views.h"

namespace pitchboard::ui {
namespace {

using CalibrationPtr = std::shared_ptr<const link::Calibration>;

const QString baseFromFile = QStringLiteral("From file…");

Result<QStringList> robotsOfSession(const QString& path) {
  const auto session = TRY(telemetry::SessionReader::open(path.toStdString()));
  QStringList names;
  for (const telemetry::SessionGroup& group : session.groups()) {
    if (factsOf(group.info).team) names << QString::fromStdString(group.info.name);
  }
  names.removeDuplicates();
  return names;
}

struct CalibrationWork {
  QStringList files;
  std::string robot, base;
  telemetry::TimeRange range{-1e18, 1e18};
};

Result<CalibrationPtr> calibrateSessions(const CalibrationWork& work, sim::FieldSpec& field,
                                         const link::CalibrationProgress& progress) {
  const auto base = TRY(link::loadRobotModel(work.base));
  std::vector<link::CalibrationLog> logs;
  for (const QString& path : work.files) {
    const auto session = TRY(telemetry::SessionReader::open(path.toStdString()));
    logs.push_back(TRY(link::readCalibrationLog(session, QFileInfo(path).fileName().toStdString(),
                                                work.robot, work.range)));
    if (!progress(0.0)) break;
  }
  field = logs.front().field;
  return std::make_shared<const link::Calibration>(TRY(link::calibrate(logs, base, {}, progress)));
}

/// Nothing typed is the whole recording.
std::optional<double> momentOr(const QLineEdit* line, double fallback) {
  const QString text = line->text().trimmed();
  return text.isEmpty() ? std::optional(fallback) : secondsFromText(text.toStdString());
}

QTableWidget* makeTable(const QStringList& columns, const char* name, QWidget* parent) {
  auto* table = new QTableWidget(0, static_cast<int>(columns.size()), parent);
  table->setObjectName(QLatin1String(name));
  table->setHorizontalHeaderLabels(columns);
  styleTable(table);
  return table;
}

void addRow(QTableWidget* table, const QStringList& texts) {
  const int row = table->rowCount();
  table->insertRow(row);
  for (int column = 0; column < texts.size(); ++column) {
    auto* item = new QTableWidgetItem(texts[column]);
    item->setToolTip(texts[column]);
    table->setItem(row, column, item);
  }
}

QString fourDigits(double value) {
  return QString::number(value, 'g', 4);
}

/// Files say "degrees", which does not fit into a column.
QString shortUnit(const std::string& unit) {
  return QString::fromStdString(unit).replace(QLatin1String("degrees"), QStringLiteral("°"));
}

}  // namespace

CalibrateDialog::CalibrateDialog(MatchController* match, QWidget* parent)
    : QDialog(parent), m_match(match) {
  setWindowTitle(QStringLiteral("Calibrate from recording"));
  setObjectName(QStringLiteral("calibrateDialog"));
  auto* halves = new QHBoxLayout;
  halves->addWidget(makeForm());
  halves->addWidget(makeResults(), 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  const auto button = [&](const char* name, QDialogButtonBox::ButtonRole role) {
    auto* made = new QPushButton(this);
    made->setObjectName(QLatin1String(name));
    made->setAutoDefault(false);
    buttons->addButton(made, role);
    return made;
  };
  m_useRobot = button("calibrateUseRobot", QDialogButtonBox::ActionRole);
  m_useTeam = button("calibrateUseTeam", QDialogButtonBox::ActionRole);
  m_save = button("calibrateSave", QDialogButtonBox::ActionRole);
  m_save->setText(QStringLiteral("Save…"));
  auto* column = new QVBoxLayout(this);
  column->addLayout(halves, 1);
  column->addWidget(buttons);
  resize(dialogSize(this, 900, 540));
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_useRobot, &QPushButton::clicked, this, [this] { use(false); });
  connect(m_useTeam, &QPushButton::clicked, this, [this] { use(true); });
  connect(m_save, &QPushButton::clicked, this, [this] {
    auto* ask = new QFileDialog(this, QStringLiteral("Save robot model"), {},
                                QStringLiteral("Robot models (*.json);;All files (*)"));
    ask->setAttribute(Qt::WA_DeleteOnClose);
    ask->setAcceptMode(QFileDialog::AcceptSave);
    ask->setDefaultSuffix(QStringLiteral("json"));
    ask->selectFile(QString::fromStdString(m_calibration->model.name) + QStringLiteral(".json"));
    connect(ask, &QFileDialog::fileSelected, this, &CalibrateDialog::saveTo);
    openInDialogFolder(ask);
  });
  for (const auto changed : {&MatchController::opened, &MatchController::scenarioChanged}) {
    connect(m_match, changed, this, &CalibrateDialog::showButtons);
  }
  connect(m_match->edits(), &MatchEdits::robotsChanged, this, &CalibrateDialog::showButtons);
  connect(m_match->edits(), &MatchEdits::lockedChanged, this, &CalibrateDialog::showButtons);
  showButtons();
  showStatus(
      QStringLiteral("Add recordings of one robot: walking in every direction with stops, turning, "
                     "and a dozen kicks."));
}

CalibrateDialog::~CalibrateDialog() {
  m_cancelled = true;
  m_worker.waitForDone();
}

QWidget* CalibrateDialog::makeForm() {
  auto* form = new QWidget(this);
  form->setFixedWidth(scaled(this, 270));
  m_files = new QListWidget(form);
  m_files->setObjectName(QStringLiteral("calibrateFiles"));
  m_files->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_files->setTextElideMode(Qt::ElideMiddle);
  const auto button = [form](const char* name, const char* text) {
    auto* made = new QPushButton(QString::fromUtf8(text), form);
    made->setObjectName(QLatin1String(name));
    made->setAutoDefault(false);
    return made;
  };
  m_add = button("calibrateAdd", "Add…");
  m_remove = button("calibrateRemove", "Remove");
  m_start = button("calibrateStart", "Calibrate");
  m_start->setDefault(true);
  m_robot = new QComboBox(form);
  m_robot->setObjectName(QStringLiteral("calibrateRobot"));
  m_base = new QComboBox(form);
  m_base->setObjectName(QStringLiteral("calibrateBase"));
  m_base->setToolTip(QStringLiteral(
      "Parameters that the recordings do not determine keep the values of this model."));
  for (const std::string& name : link::robotModels()) {
    m_base->addItem(QString::fromStdString(link::robotModelText(name).title),
                    QString::fromStdString(name));
  }
  m_base->addItem(baseFromFile);
  m_base->setCurrentIndex(std::max(0, m_base->findData(QStringLiteral("kid-size"))));
  m_from = new QLineEdit(form);
  m_from->setObjectName(QStringLiteral("calibrateFrom"));
  m_from->setPlaceholderText(QStringLiteral("start, or a time: 1:18.7"));
  m_to = new QLineEdit(form);
  m_to->setObjectName(QStringLiteral("calibrateTo"));
  m_to->setPlaceholderText(QStringLiteral("end, or a time: 2:30"));
  m_progress = new QProgressBar(form);
  m_progress->setObjectName(QStringLiteral("calibrateProgress"));
  m_progress->setRange(0, 1000);
  m_progress->setFormat(QStringLiteral("%p %"));
  m_progress->hide();
  m_message = new QLabel(form);
  m_message->setObjectName(QStringLiteral("calibrateMessage"));
  m_message->setWordWrap(true);
  m_message->setForegroundRole(QPalette::PlaceholderText);
  auto* files = new QHBoxLayout;
  files->addWidget(m_add);
  files->addWidget(m_remove);
  files->addStretch(1);
  auto* rows = new QFormLayout;
  rows->addRow(QStringLiteral("Robot"), m_robot);
  rows->addRow(QStringLiteral("Base model"), m_base);
  rows->addRow(QStringLiteral("From"), m_from);
  rows->addRow(QStringLiteral("To"), m_to);
  auto* column = new QVBoxLayout(form);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(new QLabel(QStringLiteral("Recordings"), form));
  column->addWidget(m_files, 1);
  column->addLayout(files);
  column->addLayout(rows);
  column->addWidget(m_start);
  column->addWidget(m_progress);
  column->addWidget(m_message);
  connect(m_add, &QPushButton::clicked, this, &CalibrateDialog::askForFiles);
  connect(m_remove, &QPushButton::clicked, this, &CalibrateDialog::removeFile);
  connect(m_files, &QListWidget::itemSelectionChanged, this, &CalibrateDialog::showButtons);
  connect(m_base, &QComboBox::activated, this, &CalibrateDialog::chooseBase);
  connect(m_start, &QPushButton::clicked, this, [this] {
    if (!m_calibrating) {
      start();
      return;
    }
    m_cancelled = true;
    m_start->setEnabled(false);
  });
  return form;
}

QWidget* CalibrateDialog::makeResults() {
  m_results = new QTabWidget(this);
  m_results->setObjectName(QStringLiteral("calibrateResults"));
  m_values = makeTable(
      {QStringLiteral("Parameter"), QStringLiteral("Value"), QStringLiteral("95 % interval"),
       QStringLiteral("Unit"), QStringLiteral("Base model"), QStringLiteral("From")},
      "calibrateValues", m_results);
  m_kept = makeTable({QStringLiteral("Parameter"), QStringLiteral("Why the base value is kept")},
                     "calibrateKept", m_results);
  m_predictions = new PredictionsView(m_results);
  auto* scroll = new QScrollArea(m_results);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  m_residuals = new ResidualsView(scroll);
  scroll->setWidget(m_residuals);
  m_results->addTab(m_values, QStringLiteral("Values"));
  m_results->addTab(m_predictions, QStringLiteral("Predictions"));
  m_results->addTab(scroll, QStringLiteral("Residuals"));
  m_results->addTab(m_kept, QStringLiteral("Not estimated"));
  return m_results;
}

void CalibrateDialog::askForFiles() {
  auto* ask = new QFileDialog(this, QStringLiteral("Add recordings"), {},
                              QStringLiteral("Sessions (*.mcap);;All files (*)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFiles);
  connect(ask, &QFileDialog::filesSelected, this, &CalibrateDialog::addFiles);
  openInDialogFolder(ask);
}

void CalibrateDialog::addFiles(const QStringList& paths) {
  for (const QString& path : paths) {
    m_worker.start([this, path] {
      m_toUi.post([this, path, robots = robotsOfSession(path)] { addRobots(path, robots); });
    });
  }
}

void CalibrateDialog::addRobots(const QString& path, const Result<QStringList>& robots) {
  if (!robots) {
    showStatus(QString::fromStdString(robots.error().text()), true);
    return;
  }
  if (robots->isEmpty()) {
    showStatus(QStringLiteral("%1 has no robots.").arg(QFileInfo(path).fileName()), true);
    return;
  }
  auto* item = new QListWidgetItem(QFileInfo(path).fileName(), m_files);
  item->setData(Qt::UserRole, path);
  item->setToolTip(path);
  for (const QString& name : *robots) {
    if (m_robot->findText(name) < 0) m_robot->addItem(name);
  }
  showStatus({});
  showButtons();
}

void CalibrateDialog::removeFile() {
  qDeleteAll(m_files->selectedItems());
  if (m_files->count() == 0) m_robot->clear();
  showButtons();
}

void CalibrateDialog::chooseBase(int index) {
  if (m_base->itemText(index) != baseFromFile) return;
  m_base->setCurrentIndex(std::max(0, m_base->findData(QStringLiteral("kid-size"))));
  auto* ask = new QFileDialog(this, QStringLiteral("Choose a robot model"), {},
                              QStringLiteral("Robot models (*.json);;All files (*)"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, this, [this](const QString& file) {
    const int place = m_base->count() - 1;
    m_base->insertItem(place, QFileInfo(file).fileName(), file);
    m_base->setItemData(place, file, Qt::ToolTipRole);
    m_base->setCurrentIndex(place);
  });
  openInDialogFolder(ask);
}

void CalibrateDialog::start() {
  CalibrationWork work;
  for (int i = 0; i < m_files->count(); ++i) {
    work.files << m_files->item(i)->data(Qt::UserRole).toString();
  }
  work.robot = m_robot->currentText().toStdString();
  work.base = m_base->currentData().toString().toStdString();
  const auto from = momentOr(m_from, work.range.begin), to = momentOr(m_to, work.range.end);
  if (!from || !to) {
    showStatus(QStringLiteral("From and To must be %1, or empty.").arg(QLatin1String(timeForms)),
               true);
    return;
  }
  work.range = {*from, *to};
  if (*from >= *to) {
    showStatus(QStringLiteral("The range ends before it begins."), true);
    return;
  }
  m_cancelled = false;
  m_calibrating = true;
  m_calibration.reset();
  m_progress->setValue(0);
  showStatus({});
  showValues();
  showButtons();
  m_worker.start([this, work] {
    sim::FieldSpec field;
    const auto made = calibrateSessions(work, field, [this](double part) {
      m_toUi.post([this, part] { m_progress->setValue(static_cast<int>(part * 1000)); });
      return !m_cancelled;
    });
    m_toUi.post([this, made, field] { finish(made, field); });
  });
}

void CalibrateDialog::finish(const Result<CalibrationPtr>& made, const sim::FieldSpec& field) {
  m_calibrating = false;
  if (made) {
    m_calibration = *made;
    m_predictions->show(m_calibration, field);
    m_residuals->show(m_calibration);
    const auto& c = *m_calibration;
    QString text = QStringLiteral("%1 parameters estimated from %2.")
                       .arg(c.values.size())
                       .arg(durationText(c.seconds));
    for (const auto& notes : {link::leftOutTexts(c), c.notes}) {
      for (const std::string& note : notes)
        text += QLatin1Char('\n') + QString::fromStdString(note);
    }
    showStatus(text);
  } else if (m_cancelled) {
    showStatus(QStringLiteral("Calibration cancelled."));
  } else {
    showStatus(
        QStringLiteral("Calibration failed: %1").arg(QString::fromStdString(made.error().text())),
        true);
  }
  showValues();
  showButtons();
  emit ended();
}

void CalibrateDialog::showValues() {
  m_values->setRowCount(0);
  m_kept->setRowCount(0);
  m_results->setEnabled(m_calibration != nullptr);
  if (!m_calibration) {
    m_predictions->show(nullptr, {});
    m_residuals->show(nullptr);
    return;
  }
  for (const auto* values : {&m_calibration->values, &m_calibration->estimates}) {
    for (const link::CalibratedValue& value : *values) {
      const link::WrittenValue w = link::writtenValue(value);
      const auto base = link::writtenBase(*m_calibration, value.key);
      addRow(m_values, {QString::fromStdString(value.key), fourDigits(w.value),
                        QStringLiteral("%1 to %2").arg(fourDigits(w.low), fourDigits(w.high)),
                        shortUnit(w.unit), base ? fourDigits(*base) : QStringLiteral("–"),
                        QString::fromStdString(link::samplesText(value))});
    }
  }
  for (const auto& [key, reason] : m_calibration->kept) {
    addRow(m_kept, {QString::fromStdString(key), QString::fromStdString(reason)});
  }
  m_values->resizeColumnsToContents();
  m_kept->resizeColumnsToContents();
  // Long names are elided rather than the numbers scrolled out of view; the tooltip has them whole.
  const int widestName = fontMetrics().averageCharWidth() * 29;
  m_values->setColumnWidth(0, std::min(m_values->columnWidth(0), widestName));
}

std::vector<RobotId> CalibrateDialog::robotsOfMatch(bool team) const {
  std::vector<RobotId> found;
  if (!m_calibration) return found;
  const QString name = QString::fromStdString(m_calibration->robot);
  const MatchEdits* edits = m_match->edits();
  std::optional<TeamColor> color;
  for (int id = 1; id <= sim::Simulation::maxRobots; ++id) {
    const link::ScenarioRobot* robot = edits->robot(RobotId{id});
    if (robot == nullptr || robotName(robot->identity) != name) continue;
    color = robot->identity.team;
    if (!team) return {RobotId{id}};
  }
  for (int id = 1; color && id <= sim::Simulation::maxRobots; ++id) {
    const link::ScenarioRobot* robot = edits->robot(RobotId{id});
    if (robot != nullptr && robot->identity.team == *color) found.push_back(RobotId{id});
  }
  return found;
}

void CalibrateDialog::showButtons() {
  m_start->setText(m_calibrating ? QStringLiteral("Cancel") : QStringLiteral("Calibrate"));
  m_start->setEnabled(m_calibrating || m_files->count() > 0);
  m_progress->setVisible(m_calibrating);
  for (QWidget* choice : {static_cast<QWidget*>(m_files), static_cast<QWidget*>(m_add),
                          static_cast<QWidget*>(m_robot), static_cast<QWidget*>(m_base),
                          static_cast<QWidget*>(m_from), static_cast<QWidget*>(m_to)}) {
    choice->setEnabled(!m_calibrating);
  }
  m_remove->setEnabled(!m_calibrating && !m_files->selectedItems().isEmpty());
  m_save->setEnabled(m_calibration != nullptr);
  const QString name =
      m_calibration ? QString::fromStdString(m_calibration->robot) : QStringLiteral("this robot");
  const bool possible = !robotsOfMatch(false).empty() && !m_match->edits()->isLocked() &&
                        m_match->edits()->physics() != "published";
  m_useRobot->setText(QStringLiteral("Use for %1").arg(name));
  m_useTeam->setText(QStringLiteral("Use for its team"));
  for (QPushButton* use : {m_useRobot, m_useTeam}) {
    use->setEnabled(possible);
    use->setToolTip(
        possible ? QStringLiteral("Gives the simulated robot these parameters; Undo reverts it. "
                                  "Its noise is used if the noise of the match is “robot”.")
                 : QStringLiteral("The simulated match must have a robot %1 and a physics model "
                                  "with robot models.")
                       .arg(name));
  }
}

void CalibrateDialog::use(bool team) {
  const std::vector<RobotId> ids = robotsOfMatch(team);
  if (ids.empty() || !m_match->edits()->allowsChange()) return;
  m_match->edits()->setModel(ids, m_calibration->model);
  const QString whose =
      ids.size() == 1 ? QStringLiteral("%1 uses").arg(QString::fromStdString(m_calibration->robot))
                      : QStringLiteral("%1 robots use").arg(ids.size());
  QString text = QStringLiteral("%1 these parameters now. Undo reverts it.").arg(whose);
  for (const std::string& beyond : link::beyondPriorTexts(*m_calibration))
    text += QStringLiteral("\nCheck: ") + QString::fromStdString(beyond);
  showStatus(text);
}

void CalibrateDialog::saveTo(const QString& path) {
  if (!m_calibration) return;
  const QString program = QStringLiteral("pitchboard ") + QCoreApplication::applicationVersion();
  const auto written = link::writeCalibration(path.toStdString(), *m_calibration,
                                              program.toStdString(), IfExists::Replace);
  if (written) {
    showStatus(QStringLiteral("Saved as %1").arg(path));
  } else {
    showStatus(
        QStringLiteral("Could not save: %1").arg(QString::fromStdString(written.error().text())),
        true);
  }
}

void CalibrateDialog::showStatus(const QString& sentence, bool bad) {
  QPalette colours = palette();
  if (bad) colours.setColor(QPalette::PlaceholderText, theme().errorText);
  m_message->setPalette(colours);
  m_message->setText(sentence);
}

void showCalibrateDialog(MatchController* match, QWidget* window) {
  auto* dialog = window->findChild<CalibrateDialog*>();
  if (dialog == nullptr) dialog = new CalibrateDialog(match, window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace pitchboard::ui
