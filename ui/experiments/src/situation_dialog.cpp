// SPDX-License-Identifier: GPL-3.0-or-later
#include "situation_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFontDatabase>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QStandardPaths>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include <base/file_target.h>
#include <robotlink/cognition/process_registry.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

const QString folderKey = QStringLiteral("experiments/tests");
constexpr int defaultRuns = 10, defaultSpread = 5, maxTestRuns = 10'000;
constexpr double defaultSeconds = 60.0, longest = 3600.0, metre = 100.0;
constexpr double headingSpread = 5.0;  // degrees, while starts differ at all

QString defaultFolder(const QSettings* settings) {
  QString kept = settings == nullptr ? QString() : settings->value(folderKey).toString();
  if (!kept.isEmpty()) return kept;
  return QDir(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation))
      .filePath(QStringLiteral("pitchboard-tests"));
}

bool knowsBehaviour(const link::RobotFrame& robot) {
  return !robot.behaviour.empty();
}

QWidget* inRow(QWidget* parent, std::initializer_list<QWidget*> widgets) {
  auto* row = new QWidget(parent);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  for (QWidget* one : widgets) layout->addWidget(one);
  layout->addStretch(1);
  return row;
}

}  // namespace

SituationDialog::SituationDialog(FramePtr frame, std::optional<link::Scenario> base,
                                 QSettings* settings, QWidget* parent)
    : QDialog(parent),
      m_frame(std::move(frame)),
      m_base(std::move(base)),
      m_settings(settings),
      m_name(new QLineEdit(this)),
      m_folder(new QLineEdit(QDir::toNativeSeparators(defaultFolder(settings)), this)),
      m_team(new QComboBox(this)),
      m_behaviour(new QComboBox(this)),
      m_poses(new QComboBox(this)),
      m_assertions(new QPlainTextEdit(this)),
      m_seconds(new NumberBox(this)),
      m_noCalls(new QCheckBox(QStringLiteral("Without the referee's calls"), this)),
      m_goal(new QCheckBox(QStringLiteral("goal"), this)),
      m_goalAgainst(new QCheckBox(QStringLiteral("goal against"), this)),
      m_ballOut(new QCheckBox(QStringLiteral("ball out"), this)),
      m_fell(new QCheckBox(QStringLiteral("fall"), this)),
      m_stuck(new QCheckBox(QStringLiteral("stuck"), this)),
      m_runs(new QSpinBox(this)),
      m_spread(new QSpinBox(this)),
      m_note(new QLabel(this)),
      m_problem(new QLabel(this)) {
  setObjectName(QStringLiteral("situationDialog"));
  setWindowTitle(QStringLiteral("Save this moment as a test"));
  setAttribute(Qt::WA_DeleteOnClose);
  makeForm();
  add(link::situationTemplates().front());
  m_name->selectAll();
  m_name->setFocus();
  check();
}

void SituationDialog::makeForm() {
  auto* column = new QVBoxLayout(this);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  m_name->setObjectName(QStringLiteral("testName"));
  m_name->setText(QStringLiteral("moment-%1s").arg(m_frame->snapshot.time, 0, 'f', 0));
  form->addRow(QStringLiteral("Name"), m_name);
  form->addRow(QStringLiteral("Folder"), makeFolder());
  makeRobotRows(form);
  form->addRow(QStringLiteral("Assertions"), makeAssertions());
  form->addRow(QStringLiteral("A run ends after"), makeEnds());
  m_runs->setObjectName(QStringLiteral("testRuns"));
  m_runs->setRange(1, maxTestRuns);
  m_runs->setValue(defaultRuns);
  m_runs->setToolTip(QStringLiteral("Each run has its own seed"));
  m_spread->setObjectName(QStringLiteral("testSpread"));
  m_spread->setRange(0, 100);
  m_spread->setValue(defaultSpread);
  m_spread->setSuffix(QStringLiteral(" cm"));
  m_spread->setToolTip(QStringLiteral(
      "Largest distance between a robot's start and its position here; 0 keeps it exact"));
  form->addRow(
      QStringLiteral("Runs"),
      inRow(this, {m_runs, new QLabel(QStringLiteral("from starts within"), this), m_spread}));
  column->addLayout(form);
  m_note->setWordWrap(true);
  m_note->setFont(themeFont(TypeRole::Secondary));
  column->addWidget(m_note);
  m_problem->setObjectName(QStringLiteral("testProblem"));
  m_problem->setWordWrap(true);
  m_problem->setMinimumHeight(2 * m_problem->fontMetrics().height());
  m_problem->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  column->addWidget(m_problem);
  makeButtons();
  column->addWidget(m_save->parentWidget());
  setMinimumWidth(scaled(this, 560));
  for (QLineEdit* edit : {m_name, m_folder}) {
    connect(edit, &QLineEdit::textChanged, this, &SituationDialog::check);
  }
  for (QComboBox* box : {m_team, m_behaviour, m_poses}) {
    connect(box, &QComboBox::currentIndexChanged, this, &SituationDialog::check);
  }
}

void SituationDialog::makeRobotRows(QFormLayout* form) {
  m_team->setObjectName(QStringLiteral("testTeam"));
  for (const link::RobotFrame& robot : m_frame->robots) {
    const TeamColorInfo& team = info(robot.identity.team);
    const QString name = QString::fromUtf8(team.name.data(), qsizetype(team.name.size()));
    if (m_team->findText(name) < 0) m_team->addItem(name, int(robot.identity.team));
  }
  m_team->setToolTip(QStringLiteral("Team whose goals, kicks and falls count"));
  form->addRow(QStringLiteral("Team"), m_team);
  form->setRowVisible(m_team, m_team->count() > 1);
  m_poses->setObjectName(QStringLiteral("testPoses"));
  m_poses->addItem(QStringLiteral("where they stood"));
  m_poses->addItem(QStringLiteral("where they believed they were"));
  form->addRow(QStringLiteral("Robots start"), m_poses);
  form->setRowVisible(m_poses, m_frame->truthKnown);
  m_behaviour->setObjectName(QStringLiteral("testBehaviour"));
  for (const link::BehaviourInfo& one : link::behaviours()) {
    m_behaviour->addItem(QString::fromUtf8(one.name.data(), qsizetype(one.name.size())));
  }
  m_behaviour->setCurrentText(QString::fromStdString(link::MomentOptions{}.behaviour));
  m_behaviour->setToolTip(QStringLiteral("Robots with unknown behaviour"));
  form->addRow(QStringLiteral("Their behaviour"), m_behaviour);
  form->setRowVisible(m_behaviour,
                      !std::all_of(m_frame->robots.begin(), m_frame->robots.end(), knowsBehaviour));
  m_noCalls->setObjectName(QStringLiteral("testNoCalls"));
  m_noCalls->setToolTip(
      QStringLiteral("Keeps the game state: no penalties, set plays or whistles"));
  form->addRow(QStringLiteral("Referee"), m_noCalls);
  form->setRowVisible(m_noCalls, m_frame->game.has_value());
}

QWidget* SituationDialog::makeFolder() {
  m_folder->setObjectName(QStringLiteral("testFolder"));
  auto* browse = new QToolButton(this);
  browse->setIcon(themedIcon(QStringLiteral("document-open")));
  browse->setToolTip(QStringLiteral("Choose the folder of the tests…"));
  connect(browse, &QToolButton::clicked, this, [this] {
    const QString chosen = QFileDialog::getExistingDirectory(
        this, QStringLiteral("Folder of the tests"), m_folder->text());
    if (!chosen.isEmpty()) m_folder->setText(QDir::toNativeSeparators(chosen));
  });
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(m_folder, 1);
  layout->addWidget(browse);
  return row;
}

QWidget* SituationDialog::makeAssertions() {
  m_assertions->setObjectName(QStringLiteral("testAssertions"));
  m_assertions->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  m_assertions->setPlaceholderText(QStringLiteral("goal_rate >= 0.8"));
  m_assertions->setToolTip(QStringLiteral(
      "A comparison in each line: goal_rate, time_to_goal_s, walked_m, kicks_B1, belief_error_m, "
      "possession, … with mean(), median(), min(), max(), p95(). All must hold."));
  m_assertions->setTabChangesFocus(true);
  m_assertions->setFixedHeight(5 * m_assertions->fontMetrics().lineSpacing());
  connect(m_assertions, &QPlainTextEdit::textChanged, this, &SituationDialog::check);
  auto* more = new QToolButton(this);
  more->setObjectName(QStringLiteral("testTemplates"));
  more->setText(QStringLiteral("Add…"));
  more->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more);
  for (const link::SituationTemplate& one : link::situationTemplates()) {
    menu->addAction(QString::fromUtf8(one.text), this, [this, &one] { add(one); });
  }
  more->setMenu(menu);
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(m_assertions, 1);
  layout->addWidget(more, 0, Qt::AlignTop);
  return row;
}

QWidget* SituationDialog::makeEnds() {
  m_seconds->setObjectName(QStringLiteral("testSeconds"));
  m_seconds->setRange(1.0, longest);
  m_seconds->setDecimals(1);
  m_seconds->setValue(defaultSeconds);
  m_seconds->setSuffix(QStringLiteral(" s"));
  m_stuck->setToolTip(QStringLiteral("Neither the ball nor a robot of the team moves for %1 s")
                          .arg(link::situationStuck));
  connect(m_seconds, &NumberBox::valueChanged, this, &SituationDialog::check);
  for (QCheckBox* box : {m_goal, m_goalAgainst, m_ballOut, m_fell, m_stuck}) {
    connect(box, &QCheckBox::toggled, this, &SituationDialog::check);
  }
  return inRow(this, {m_seconds, new QLabel(QStringLiteral("or with a"), this), m_goal,
                      m_goalAgainst, m_ballOut, m_fell, m_stuck});
}

void SituationDialog::makeButtons() {
  auto* box = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  m_play = box->addButton(QStringLiteral("Save and run"), QDialogButtonBox::AcceptRole);
  m_play->setObjectName(QStringLiteral("testPlay"));
  m_play->setDefault(true);
  m_save = box->addButton(QStringLiteral("Save"), QDialogButtonBox::ActionRole);
  m_save->setObjectName(QStringLiteral("testSave"));
  connect(m_play, &QPushButton::clicked, this, [this] { save(true); });
  connect(m_save, &QPushButton::clicked, this, [this] { save(false); });
  connect(box, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

void SituationDialog::add(const link::SituationTemplate& one) {
  const std::pair<QCheckBox*, bool> ends[] = {{m_goal, one.goal},
                                              {m_goalAgainst, one.goalAgainst},
                                              {m_ballOut, one.ballOut},
                                              {m_fell, one.fell},
                                              {m_stuck, one.stuck}};
  for (const auto& [box, needed] : ends) {
    if (needed) box->setChecked(true);
  }
  m_assertions->appendPlainText(QString::fromUtf8(one.assertion));
}

link::SituationTest SituationDialog::situation() const {
  link::MomentOptions options;
  options.behaviour = m_behaviour->currentText().toStdString();
  if (m_poses->currentIndex() == 1) {
    options.poses = link::MomentOptions::Poses::Believed;
    options.ball = link::MomentOptions::Ball::Perceived;
  }
  if (m_base) options.base = &*m_base;
  link::MomentScenario moment = link::situationScenario(*m_frame, options);
  link::SituationTest out;
  const std::string title = m_name->text().trimmed().toStdString();
  out.name = link::experimentNameFrom(title);
  out.title = title;
  out.description = moment.scenario.title + '.';
  for (const std::string& note : moment.notes) out.description += ' ' + note;
  out.scenario = std::move(moment.scenario);
  out.scenario.name = out.name;
  if (auto& rules = out.scenario.settings.referee; rules && m_noCalls->isChecked()) {
    rules->automatic = false;
  }
  out.team = static_cast<TeamColor>(m_team->currentData().toInt());
  out.runs = static_cast<std::size_t>(m_runs->value());
  const double spread = m_spread->value() / metre;
  out.robots = {"robots", spread, spread, spread > 0.0 ? headingSpread : 0.0};
  out.ball = {"ball", spread / 2, spread / 2, 0.0};
  out.stop.duration = m_seconds->value();
  out.stop.goal = m_goal->isChecked();
  out.stop.goalAgainst = m_goalAgainst->isChecked();
  out.stop.ballOut = m_ballOut->isChecked();
  out.stop.fell = m_fell->isChecked();
  if (m_stuck->isChecked()) out.stop.stuck = link::situationStuck;
  for (const QString& line : m_assertions->toPlainText().split(QLatin1Char('\n'))) {
    if (!line.trimmed().isEmpty()) out.assertions.push_back(line.trimmed().toStdString());
  }
  return out;
}

QString SituationDialog::path() const {
  const QString name =
      QString::fromStdString(link::experimentNameFrom(m_name->text().trimmed().toStdString()));
  return QDir(QDir::fromNativeSeparators(m_folder->text().trimmed()))
      .filePath(name + QStringLiteral(".json"));
}

void SituationDialog::check() {
  if (m_play == nullptr) return;
  const link::SituationTest asked = situation();
  m_note->setText(QString::fromStdString(asked.description));
  const auto made = link::situationToJson(asked);
  QString text;
  if (!made) {
    text = QString::fromStdString(made.error().message);
  } else if (m_folder->text().trimmed().isEmpty()) {
    text = QStringLiteral("Choose a folder.");
  }
  const bool usable = text.isEmpty();
  if (usable) {
    text = QFileInfo::exists(path()) ? QStringLiteral("%1 exists and will be replaced.")
                                     : QStringLiteral("%1");
    text = text.arg(QDir::toNativeSeparators(path()));
  }
  showStatus(text, usable ? theme().secondaryText : theme().errorText);
  m_play->setEnabled(usable);
  m_save->setEnabled(usable);
}

void SituationDialog::showStatus(const QString& text, const QColor& colour) {
  QPalette colours = palette();
  colours.setColor(QPalette::WindowText, colour);
  m_problem->setPalette(colours);
  m_problem->setText(text);
}

void SituationDialog::save(bool play) {
  const auto text = link::situationToJson(situation());
  if (!text) return check();
  const QString to = path();
  QDir().mkpath(QFileInfo(to).path());
  const auto written = writeFile(to.toStdString(), *text, IfExists::Replace);
  if (!written)
    return showStatus(QString::fromStdString(written.error().text()), theme().errorText);
  if (m_settings != nullptr) m_settings->setValue(folderKey, QFileInfo(to).path());
  emit saved(to, play);
  accept();
}

}  // namespace pitchboard::ui
