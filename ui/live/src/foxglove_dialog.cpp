// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/foxglove_dialog.h>

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/dialog_size.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/live/live_status.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/live_settings.h>

namespace pitchboard::ui {
namespace {

enum SourceColumn { AddressColumn, RobotColumn, StateColumn, sourceColumnCount };

QString colourText(TeamColor team) {
  return QString::fromStdString(std::string(info(team).name));
}

/// "robot 3, red"
QString robotsText(const link::FoxgloveSource& source) {
  return source.robot > 0
             ? QStringLiteral("robot %1, %2").arg(source.robot).arg(colourText(source.team))
             : colourText(source.team);
}

}  // namespace

FoxgloveDialog::FoxgloveDialog(LiveController* live, QSettings* settings, QWidget* parent)
    : QDialog(parent), m_live(live), m_settings(settings) {
  constexpr int refreshMilliseconds = 500;
  setObjectName(QStringLiteral("foxgloveDialog"));
  setWindowTitle(QStringLiteral("Foxglove bridges"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* about = new QLabel(
      QStringLiteral(
          "Live shows the topics of robots that run foxglove_bridge (ROS 2), and of other "
          "programs that speak Foxglove's protocol. It only reads them."),
      this);
  about->setWordWrap(true);
  m_sources = new QTableWidget(0, sourceColumnCount, this);
  m_sources->setObjectName(QStringLiteral("foxgloveSources"));
  m_sources->setHorizontalHeaderLabels(
      {QStringLiteral("Address"), QStringLiteral("Robots"), QStringLiteral("State")});
  styleTable(m_sources);
  m_sources->setSelectionMode(QAbstractItemView::SingleSelection);
  for (int column = 0; column < StateColumn; ++column) {
    m_sources->horizontalHeader()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  m_problem = new InPlaceMessage(this);
  m_problem->setObjectName(QStringLiteral("foxgloveProblem"));
  m_problem->clear();
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  auto* add = buttons->addButton(QStringLiteral("Add"), QDialogButtonBox::ActionRole);
  add->setObjectName(QStringLiteral("addFoxglove"));
  add->setDefault(true);
  m_remove = buttons->addButton(QStringLiteral("Remove"), QDialogButtonBox::ActionRole);
  m_remove->setObjectName(QStringLiteral("removeFoxglove"));
  connect(add, &QPushButton::clicked, this, &FoxgloveDialog::add);
  connect(m_remove, &QPushButton::clicked, this, &FoxgloveDialog::remove);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_sources, &QTableWidget::itemSelectionChanged, this, &FoxgloveDialog::choose);
  auto* column = new QVBoxLayout(this);
  column->addWidget(about);
  column->addWidget(m_sources, 1);
  column->addWidget(makeForm());
  column->addWidget(m_problem);
  column->addWidget(buttons);
  resize(dialogSize(this, 620, 380));
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] {
    if (isVisible()) refresh();
  });
  timer->start(refreshMilliseconds);
  connect(live, &LiveController::optionsChanged, this, &FoxgloveDialog::refresh);
  refresh();
  m_address->setFocus();
}

QWidget* FoxgloveDialog::makeForm() {
  auto* widget = new QWidget(this);
  auto* form = new QFormLayout(widget);
  form->setContentsMargins(0, 0, 0, 0);
  m_address = new QLineEdit(widget);
  m_address->setObjectName(QStringLiteral("foxgloveAddress"));
  m_address->setPlaceholderText(QStringLiteral("ws://robot3:8765"));
  m_robot = new QSpinBox(widget);
  m_robot->setObjectName(QStringLiteral("foxgloveRobot"));
  m_robot->setRange(0, 99);
  m_robot->setSpecialValueText(QStringLiteral("from its name"));
  m_robot->setToolTip(QStringLiteral(
      "Number of the robot whose topics have no namespace. From its name: that at the end of the "
      "host's name or of the namespace, or else the next that is free"));
  m_team = new QComboBox(widget);
  m_team->setObjectName(QStringLiteral("foxgloveTeam"));
  for (const TeamColorInfo& colour : teamColors) {
    m_team->addItem(colourText(colour.color), static_cast<int>(colour.color));
  }
  form->addRow(QStringLiteral("Address"), m_address);
  form->addRow(QStringLiteral("Robot"), m_robot);
  form->addRow(QStringLiteral("Team"), m_team);
  form->addRow(QStringLiteral("Mapping"), makeMappingRow());
  return widget;
}

QWidget* FoxgloveDialog::makeMappingRow() {
  auto* widget = new QWidget(this);
  m_mapping = new QLineEdit(widget);
  m_mapping->setObjectName(QStringLiteral("foxgloveMapping"));
  m_mapping->setPlaceholderText(QStringLiteral("usual messages of ROS"));
  m_mapping->setToolTip(
      QStringLiteral("File that says which topics are robots, ball, battery, log and referee"));
  auto* browse = new QPushButton(QStringLiteral("Choose…"), widget);
  browse->setAutoDefault(false);
  connect(browse, &QPushButton::clicked, this, &FoxgloveDialog::chooseMapping);
  auto* edit = new QPushButton(QStringLiteral("Map topics…"), widget);
  edit->setObjectName(QStringLiteral("foxgloveMapTopics"));
  edit->setAutoDefault(false);
  connect(edit, &QPushButton::clicked, this, &FoxgloveDialog::editMapping);
  auto* row = new QHBoxLayout(widget);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(m_mapping, 1);
  row->addWidget(browse);
  row->addWidget(edit);
  return widget;
}

void FoxgloveDialog::chooseMapping() {
  const QString file = askToOpen(this, QStringLiteral("Choose mapping"),
                                 QStringLiteral("Mappings (*.json);;All files (*)"));
  if (!file.isEmpty()) m_mapping->setText(file);
}

void FoxgloveDialog::editMapping() {
  const auto address = telemetry::parseFoxgloveAddress(m_address->text().trimmed().toStdString());
  if (!address) {
    showProblem(QString::fromStdString(address.error().message));
    return;
  }
  emit mappingWanted(QString::fromStdString(address->text()), m_mapping->text().trimmed());
}

void FoxgloveDialog::setMapping(const QString& address, const QString& file) {
  std::vector<link::FoxgloveSource> sources = m_live->options().foxglove;
  const auto known = std::ranges::find_if(sources, [&](const link::FoxgloveSource& one) {
    return QString::fromStdString(one.address.text()) == address;
  });
  if (m_address->text().isEmpty() || known != sources.end()) m_address->setText(address);
  m_mapping->setText(file);
  if (known == sources.end()) return;  // it is added with the mapping
  known->mappingFile = file.toStdString();
  use(sources);
}

void FoxgloveDialog::refresh() {
  const std::vector<link::FoxgloveSource>& sources = m_live->options().foxglove;
  const std::vector<link::TopicSourceStatus> known = m_live->details().topics;
  const QSignalBlocker quiet(m_sources);
  m_sources->setRowCount(static_cast<int>(sources.size()));
  for (int row = 0; row < m_sources->rowCount(); ++row) {
    const link::FoxgloveSource& source = sources[static_cast<std::size_t>(row)];
    const auto status = std::ranges::find(known, source, &link::TopicSourceStatus::source);
    const QString state = status != known.end()   ? topicsText(*status)
                          : m_live->isListening() ? QStringLiteral("connecting…")
                                                  : QStringLiteral("Switch to Live to connect.");
    const QStringList texts{QString::fromStdString(source.address.text()), robotsText(source),
                            state.section(QLatin1Char('\n'), 0, 0)};
    for (int column = 0; column < texts.size(); ++column) {
      QTableWidgetItem* item = m_sources->item(row, column);
      if (item == nullptr) m_sources->setItem(row, column, item = new QTableWidgetItem);
      item->setText(texts[column]);
      item->setToolTip(column == StateColumn ? state : texts[column]);
    }
  }
  m_remove->setEnabled(m_sources->currentRow() >= 0);
}

/// The form shows what is selected, to be changed.
void FoxgloveDialog::choose() {
  const std::vector<link::FoxgloveSource>& sources = m_live->options().foxglove;
  const int row = m_sources->currentRow();
  m_remove->setEnabled(row >= 0);
  if (row < 0 || row >= static_cast<int>(sources.size())) return;
  const link::FoxgloveSource& source = sources[static_cast<std::size_t>(row)];
  m_address->setText(QString::fromStdString(source.address.text()));
  m_robot->setValue(source.robot);
  m_team->setCurrentIndex(m_team->findData(static_cast<int>(source.team)));
  m_mapping->setText(QString::fromStdString(source.mappingFile));
}

bool FoxgloveDialog::use(const std::vector<link::FoxgloveSource>& sources) {
  if (const auto good = link::validate(sources); !good) {
    // What is wrong with a mapping is in its file; other mistakes are in the form above.
    const bool isInFile = !good.error().context.starts_with("--foxglove");
    return showProblem(
        QString::fromStdString(isInFile ? good.error().text() : good.error().message));
  }
  link::LiveOptions options = m_live->options();
  options.foxglove = sources;
  m_live->setOptions(options);
  saveLiveOption(*m_settings, "foxglove", options);
  m_problem->clear();
  refresh();
  return true;
}

bool FoxgloveDialog::add() {
  const auto address = telemetry::parseFoxgloveAddress(m_address->text().trimmed().toStdString());
  if (!address) return showProblem(QString::fromStdString(address.error().message));
  std::vector<link::FoxgloveSource> sources = m_live->options().foxglove;
  auto known = std::ranges::find(sources, *address, &link::FoxgloveSource::address);
  if (known == sources.end()) known = sources.insert(known, link::FoxgloveSource{*address});
  known->robot = m_robot->value();
  known->team = static_cast<TeamColor>(m_team->currentData().toInt());
  known->mappingFile = m_mapping->text().trimmed().toStdString();
  return use(sources);
}

void FoxgloveDialog::remove() {
  std::vector<link::FoxgloveSource> sources = m_live->options().foxglove;
  const int row = m_sources->currentRow();
  if (row < 0 || row >= static_cast<int>(sources.size())) return;
  sources.erase(sources.begin() + row);
  use(sources);
}

bool FoxgloveDialog::showProblem(const QString& sentence) {
  m_problem->showMessage(InPlaceMessage::Tone::Error, sentence);
  return false;
}

FoxgloveDialog* showFoxgloveDialog(LiveController* live, QSettings* settings, QWidget* window) {
  auto* dialog = window->findChild<FoxgloveDialog*>();
  if (dialog == nullptr) dialog = new FoxgloveDialog(live, settings, window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
  return dialog;
}

}  // namespace pitchboard::ui
