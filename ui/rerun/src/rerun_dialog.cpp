// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/rerun/rerun_dialog.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <cmath>

#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/cognition/process_registry.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_time.h>
#include <ui/base/dialog_size.h>
#include <ui/base/explanation.h>
#include <ui/base/file_dialog.h>
#include <ui/base/number_box.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

constexpr int planMilliseconds = 250;  // after the last key
constexpr qsizetype maxRecentPrograms = 6;
const QString recentProgramsKey = QStringLiteral("rerun/programs");
const QString ourProgram = QStringLiteral("reference");
const QString wholeProfile = QStringLiteral("All of a profile");

struct RerunSpeed {
  const char* text;
  double timesRealTime;  // 0: as fast as possible
};
constexpr RerunSpeed rerunSpeeds[] = {
    {"As fast as possible", 0.0}, {"×0.5", 0.5}, {"Real time", 1.0}, {"×2", 2.0}, {"×5", 5.0}};

const char* knownText(link::RerunPlan::Known known) {
  switch (known) {
    case link::RerunPlan::Known::Map:
      return "Map of variables";
    case link::RerunPlan::Known::Name:
      return "Its name";
    case link::RerunPlan::Known::Chosen:
      return "Named above";
  }
  return "";
}

/// Whether our process of this name can run again: not that which only talks by radio.
bool hasReference(const QString& process) {
  return link::findProcess(process.toStdString()) != nullptr &&
         process != QLatin1String("communication");
}

QComboBox* programBox(const char* name, QWidget* parent) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QLatin1String(name));
  box->setEditable(true);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  return box;
}

}  // namespace

struct RerunDialog::Reader {
  std::string path;
  std::optional<telemetry::SessionReader> session;

  Result<link::RerunPlan> plan(const std::string& of, const link::RerunOptions& options) {
    if (!session || path != of) {
      session.reset();
      session.emplace(TRY(telemetry::SessionReader::open(of)));
      path = of;
    }
    return link::planRerun(*session, options);
  }
};

RerunDialog::RerunDialog(const RerunDialogParts& parts, QWidget* parent)
    : QDialog(parent), m_parts(parts), m_reader(std::make_shared<Reader>()) {
  setWindowTitle(QStringLiteral("Rerun with a program"));
  setObjectName(QStringLiteral("rerunDialog"));
  auto* halves = new QHBoxLayout;
  halves->addWidget(makeForm());
  halves->addWidget(makePlan(), 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_start = new QPushButton(this);
  m_start->setObjectName(QStringLiteral("rerunStart"));
  m_start->setDefault(true);
  buttons->addButton(m_start, QDialogButtonBox::ActionRole);
  m_progress = new QProgressBar(this);
  m_progress->setObjectName(QStringLiteral("rerunProgress"));
  m_progress->setRange(0, 100);
  m_message = new QLabel(this);
  m_message->setObjectName(QStringLiteral("rerunMessage"));
  m_message->setWordWrap(true);
  auto* column = new QVBoxLayout(this);
  column->addLayout(halves, 1);
  column->addWidget(m_progress);
  column->addWidget(m_message);
  column->addWidget(buttons);
  resize(dialogSize(this, 860, 520));
  m_plan.setSingleShot(true);
  m_plan.setInterval(planMilliseconds);
  connect(&m_plan, &QTimer::timeout, this, &RerunDialog::plan);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_start, &QPushButton::clicked, this, [this] {
    if (m_parts.rerunner->isRunning()) {
      m_parts.rerunner->cancel();
      showMessage(QStringLiteral("Cancelled."), false);
    } else {
      start();
    }
  });
  connect(parts.rerunner, &Rerunner::changed, this, &RerunDialog::showState);
  connect(parts.rerunner, &Rerunner::finished, this, [this] {
    // What there is to say of it is in the panel.
    if (std::exchange(m_started, false)) hide();
  });
  takeRecording();
}

RerunDialog::~RerunDialog() {
  m_worker.waitForDone();
}

QWidget* RerunDialog::makeForm() {
  auto* form = new QWidget(this);
  form->setFixedWidth(scaled(this, 330));
  const auto combo = [form](const char* name) {
    auto* box = new QComboBox(form);
    box->setObjectName(QLatin1String(name));
    return box;
  };
  const auto line = [form](const char* name, const char* placeholder, const char* tip) {
    auto* edit = new QLineEdit(form);
    edit->setObjectName(QLatin1String(name));
    edit->setPlaceholderText(QString::fromUtf8(placeholder));
    edit->setToolTip(QString::fromUtf8(tip));
    return edit;
  };
  m_robot = combo("rerunRobot");
  m_process = combo("rerunProcess");
  m_program = programBox("rerunProgram", form);
  m_browse = new QPushButton(QStringLiteral("Browse…"), form);
  m_browse->setObjectName(QStringLiteral("rerunBrowse"));
  m_browse->setAutoDefault(false);
  m_writes = line("rerunWrites", "BRAIN_*",
                  "More variables that the process writes; * stands for any text");
  m_begin = line("rerunBegin", "start, or a time: 1:18.7", "Compare from this time on");
  m_end = line("rerunEnd", "end, or a time: 2:30", "Compare until this time");
  m_warmUp = line("rerunWarmUp", "automatic",
                  "Seconds before From that are played and not compared, because a process "
                  "remembers what happened. Automatic: everything in lock-step, otherwise 10 s");
  m_speed = combo("rerunSpeed");
  m_speed->setToolTip(QStringLiteral("The clocks of programs follow the recording at any speed"));
  for (const RerunSpeed& speed : rerunSpeeds) {
    m_speed->addItem(QString::fromUtf8(speed.text), speed.timesRealTime);
  }
  m_check = new QCheckBox(QStringLiteral("C&heck reproducibility first"), form);
  m_check->setObjectName(QStringLiteral("rerunCheck"));
  m_check->setToolTip(
      QStringLiteral("Runs the unchanged program, too. What differs then, such as random numbers, "
                     "is kept beside the recording and left out from now on"));
  m_unchanged = programBox("rerunUnchanged", form);
  m_unchanged->setToolTip(QStringLiteral("The program as it was when this was recorded"));
  auto* program = new QHBoxLayout;
  program->addWidget(m_program, 1);
  program->addWidget(m_browse);
  auto* rows = new QFormLayout(form);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addRow(QStringLiteral("R&obot"), m_robot);
  rows->addRow(QStringLiteral("Pro&cess"), m_process);
  auto* named = new QLabel(QStringLiteral("&Program"), form);
  named->setBuddy(m_program);
  rows->addRow(named, program);
  rows->addRow(makeMore(form));
  rows->addRow(makeExplanation(
      QStringLiteral("“reference” is ours, as it was recorded; decision may be a behaviour, too. "
                     "Otherwise a program with its arguments (${key}: its blackboard), or a "
                     "runtime profile (.json), of which all processes can run."),
      form));
  rows->addRow(QStringLiteral("Also &writes"), m_writes);
  rows->addRow(QStringLiteral("&From"), m_begin);
  rows->addRow(QStringLiteral("&Until"), m_end);
  rows->addRow(QStringLiteral("Wa&rm-up (s)"), m_warmUp);
  rows->addRow(QStringLiteral("&Speed"), m_speed);
  rows->addRow(m_check);
  rows->addRow(QStringLiteral("Unchan&ged"), m_unchanged);
  m_unchanged->setEnabled(false);
  connect(m_check, &QCheckBox::toggled, this, &RerunDialog::showState);
  connect(m_robot, &QComboBox::currentIndexChanged, this, &RerunDialog::showProcesses);
  connect(m_process, &QComboBox::currentIndexChanged, this, &RerunDialog::showPrograms);
  connect(m_program, &QComboBox::editTextChanged, this, &RerunDialog::planSoon);
  for (QLineEdit* edit : {m_writes, m_begin, m_end, m_warmUp}) {
    connect(edit, &QLineEdit::textChanged, this, &RerunDialog::planSoon);
  }
  connect(m_browse, &QPushButton::clicked, this, [this] { browse(m_program); });
  return form;
}

QWidget* RerunDialog::makePlan() {
  auto* plan = new QWidget(this);
  m_outputs = new QTableWidget(0, 3, plan);
  m_outputs->setObjectName(QStringLiteral("rerunOutputs"));
  m_outputs->setHorizontalHeaderLabels({QStringLiteral("The process writes"),
                                        QStringLiteral("Known from"), QStringLiteral("Recorded")});
  styleTable(m_outputs);
  m_outputs->setColumnWidth(0, scaled(this, 220));
  m_outputs->setColumnWidth(1, scaled(this, 120));
  m_notes = new QLabel(plan);
  m_notes->setObjectName(QStringLiteral("rerunNotes"));
  m_notes->setWordWrap(true);
  auto* column = new QVBoxLayout(plan);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(m_outputs, 1);
  column->addWidget(m_notes);
  return plan;
}

void RerunDialog::takeRecording() {
  const QString recording = m_parts.rerunner->recording();
  m_robots = m_parts.rerunner->robots();
  const QString before = m_recording == recording ? m_robot->currentText() : QString();
  m_recording = recording;
  {
    const QSignalBlocker quiet(m_robot);
    m_robot->clear();
    for (const auto& robot : m_robots) m_robot->addItem(robot.first);
    int chosen = m_robot->findText(before);
    const FramePtr frame = m_parts.shown->frame();
    for (const RobotUid uid : m_parts.selection->ids()) {
      const link::RobotFrame* robot = frame ? frame->robot(uid) : nullptr;
      const int at = robot ? m_robot->findText(QString::fromStdString(robot->name)) : -1;
      if (at >= 0) chosen = at;
    }
    m_robot->setCurrentIndex(std::max(chosen, 0));
  }
  auto range = m_parts.shown->selection();
  if (!range && m_parts.shown->hasMarks()) {
    const auto [a, b] = m_parts.shown->marks();
    range = telemetry::TimeRange{std::min(*a, *b), std::max(*a, *b)};
  }
  m_begin->setText(range ? QString::fromStdString(secondsToText(range->begin)) : QString());
  m_end->setText(range ? QString::fromStdString(secondsToText(range->end)) : QString());
  showProcesses();
  showMessage({}, false);
  showState();
}

/// Those of the robot in the recording.
QStringList RerunDialog::processes() const {
  const int at = m_robot->currentIndex();
  return at < 0 ? QStringList() : m_robots[static_cast<std::size_t>(at)].second;
}

void RerunDialog::showProcesses() {
  const auto fill = [this](QComboBox* box, const QString& usual) {
    const QSignalBlocker quiet(box);
    const QString before = box->currentText();
    box->clear();
    box->addItems(processes());
    if (box == m_process) box->addItem(wholeProfile);
    const int kept = box->findText(before);
    box->setCurrentIndex(std::max(0, kept >= 0 ? kept : box->findText(usual)));
  };
  fill(m_process, QStringLiteral("decision"));
  for (const Row& row : m_rows) fill(row.process, {});
  showPrograms();
}

bool RerunDialog::isWholeProfile() const {
  return m_process->currentText() == wholeProfile;
}

QWidget* RerunDialog::makeMore(QWidget* form) {
  auto* more = new QWidget(form);
  m_more = new QVBoxLayout(more);
  m_more->setContentsMargins(0, 0, 0, 0);
  m_add = new QPushButton(QStringLiteral("&Add a process"), more);
  m_add->setObjectName(QStringLiteral("rerunAddProcess"));
  m_add->setToolTip(QStringLiteral("Run another process of the robot at the same time"));
  m_add->setAutoDefault(false);
  m_more->addWidget(m_add, 0, Qt::AlignLeft);
  connect(m_add, &QPushButton::clicked, this, &RerunDialog::addRow);
  return more;
}

void RerunDialog::addRow() {
  Row row;
  row.box = new QWidget(m_more->parentWidget());
  row.process = new QComboBox(row.box);
  row.process->setObjectName(QStringLiteral("rerunMoreProcess"));
  row.process->addItems(processes());
  for (const QString& process : processes()) {
    const bool isFree = process != m_process->currentText() &&
                        std::ranges::none_of(m_rows, [&process](const Row& other) {
                          return other.process->currentText() == process;
                        });
    if (!isFree || !hasReference(process)) continue;
    row.process->setCurrentText(process);
    break;
  }
  row.program = programBox("rerunMoreProgram", row.box);
  auto* remove = new QToolButton(row.box);
  remove->setObjectName(QStringLiteral("rerunRemoveProcess"));
  remove->setIcon(themedIcon(QStringLiteral("list-remove")));
  remove->setAutoRaise(true);
  remove->setToolTip(QStringLiteral("Do not run this process"));
  remove->setAccessibleName(remove->toolTip());
  auto* line = new QHBoxLayout(row.box);
  line->setContentsMargins(0, 0, 0, 0);
  line->addWidget(row.process);
  line->addWidget(row.program, 1);
  line->addWidget(remove);
  m_more->insertWidget(static_cast<int>(m_rows.size()), row.box);
  m_rows.push_back(row);
  connect(row.process, &QComboBox::currentIndexChanged, this, &RerunDialog::showPrograms);
  connect(row.program, &QComboBox::editTextChanged, this, &RerunDialog::planSoon);
  connect(remove, &QToolButton::clicked, this, [this, box = row.box] { removeRow(box); });
  showPrograms();
  showState();
  row.process->setFocus();
}

void RerunDialog::removeRow(const QWidget* box) {
  const auto found = std::ranges::find(m_rows, box, &Row::box);
  if (found == m_rows.end()) return;
  found->box->hide();
  found->box->deleteLater();
  m_rows.erase(found);
  m_add->setFocus();
  planSoon();
  showState();
}

std::vector<link::RerunProcess> RerunDialog::chosenProcesses() const {
  const auto programIn = [this](const QComboBox* box) {
    return link::besideRecording(box->currentText().trimmed().toStdString(),
                                 m_recording.toStdString());
  };
  if (isWholeProfile()) return {{{}, programIn(m_program)}};
  std::vector<link::RerunProcess> chosen{
      {m_process->currentText().toStdString(), programIn(m_program)}};
  for (const Row& row : m_rows) {
    chosen.push_back({row.process->currentText().toStdString(), programIn(row.program)});
  }
  return chosen;
}

/// What ran when it was recorded: the first process as typed, the others as the recording tells.
Result<std::vector<link::RerunProcess>> RerunDialog::unchangedProcesses() const {
  std::vector<link::RerunProcess> unchanged = m_recordedAs;
  if (!isWholeProfile()) {
    const std::string first = m_process->currentText().toStdString();
    std::erase_if(unchanged, [&first](const auto& process) { return process.name == first; });
    unchanged.insert(
        unchanged.begin(),
        {first, link::besideRecording(m_unchanged->currentText().trimmed().toStdString(),
                                      m_recording.toStdString())});
  }
  for (const link::RerunProcess& process : unchanged) {
    if (!process.program.empty()) continue;
    return failure(ErrorCode::InvalidArgument,
                   unchanged.size() == 1 && !isWholeProfile()
                       ? "To check reproducibility, say which program is the unchanged one."
                       : "To check reproducibility, it must be known what ran. The recording does "
                         "not tell it of " +
                             process.name + '.');
  }
  return unchanged;
}

void RerunDialog::showPrograms() {
  const QString process = m_process->currentText();
  fillPrograms(m_program, process, true);
  fillPrograms(m_unchanged, process, false);
  for (const Row& row : m_rows) fillPrograms(row.program, row.process->currentText(), true);
  showState();
  planSoon();
}

void RerunDialog::fillPrograms(QComboBox* box, const QString& process, bool proposesOurs) {
  const QStringList recent = m_parts.settings == nullptr
                                 ? QStringList()
                                 : m_parts.settings->value(recentProgramsKey).toStringList();
  const bool ours = hasReference(process) || process == wholeProfile;
  const QSignalBlocker quiet(box);
  const QString before = box->currentText();
  box->clear();
  box->addItems(process == wholeProfile ? recent.filter(QStringLiteral(".json")) : recent);
  if (ours) box->addItem(ourProgram);
  if (process == QLatin1String("decision")) {
    for (const link::BehaviourInfo& behaviour : link::behaviours()) {
      box->addItem(
          QString::fromUtf8(behaviour.name.data(), static_cast<qsizetype>(behaviour.name.size())));
    }
  }
  const QString usual = proposesOurs && ours ? ourProgram : QString();
  box->setEditText(before.isEmpty() ? usual : before);
}

void RerunDialog::browse(QComboBox* program) {
  auto* ask = new QFileDialog(this, QStringLiteral("Choose a program or a runtime profile"));
  ask->setAttribute(Qt::WA_DeleteOnClose);
  ask->setFileMode(QFileDialog::ExistingFile);
  connect(ask, &QFileDialog::fileSelected, program, &QComboBox::setEditText);
  openInDialogFolder(ask);
}

Result<RerunOrder> RerunDialog::order() const {
  RerunOrder order;
  link::RerunOptions& options = order.options;
  options.robot = m_robot->currentText().toStdString();
  options.processes = chosenProcesses();
  for (const QString& one : m_writes->text().split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    options.writes.push_back(one.toStdString());
  }
  const auto all = m_parts.shown->available().value_or(telemetry::TimeRange{});
  const auto clock = m_parts.shown->clock();
  const telemetry::WallTime begin(
      std::chrono::milliseconds(clock ? clock->toMSecsSinceEpoch() : 0));
  const auto take = [&](const QLineEdit* edit, std::optional<double>& time) -> Result<void> {
    const std::string text = edit->text().trimmed().toStdString();
    if (!text.empty()) time = TRY(telemetry::sessionTime(text, begin, all));
    return {};
  };
  TRY(take(m_begin, options.from));
  TRY(take(m_end, options.until));
  const QString warmUp = m_warmUp->text().trimmed();
  if (!warmUp.isEmpty() && warmUp != QLatin1String("automatic")) {
    options.warmUp = numberFromText(warmUp);
    if (!options.warmUp || *options.warmUp < 0.0) {
      return failure(ErrorCode::ParseError,
                     "Warm-up must be a number of seconds, such as 10, or empty.");
    }
  }
  options.speed = m_speed->currentData().toDouble();
  return order;
}

void RerunDialog::planSoon() {
  ++m_plans;
  m_plan.start();
  m_canRun = true;  // as far as is known
  m_start->setEnabled(m_parts.rerunner->whyNot().isEmpty());
}

void RerunDialog::plan() {
  if (m_recording.isEmpty() || m_robot->count() == 0) return;
  const auto wanted = order();
  if (!wanted) return showPlan(tl::unexpected(wanted.error()));
  m_worker.start([this, reader = m_reader, path = m_recording.toStdString(),
                  options = wanted->options, mine = m_plans] {
    auto made = reader->plan(path, options);
    m_ui.post([this, made = std::move(made), mine] {
      if (mine == m_plans) showPlan(made);
    });
  });
}

void RerunDialog::showPlan(const Result<link::RerunPlan>& plan) {
  m_outputs->setRowCount(0);
  m_outputs->setEnabled(plan.has_value());
  QStringList notes;
  if (plan) {
    for (const link::RerunPlan::Output& output : plan->outputs) {
      const int row = m_outputs->rowCount();
      m_outputs->insertRow(row);
      const QString texts[] = {QString::fromStdString(output.variable),
                               QString::fromUtf8(knownText(output.known)),
                               output.isRecorded ? QStringLiteral("yes") : QStringLiteral("no")};
      for (int column = 0; column < 3; ++column) {
        auto* item = new QTableWidgetItem(texts[column]);
        // Without a recorded value there is nothing to compare with.
        if (!output.isRecorded) item->setForeground(theme().secondaryText);
        m_outputs->setItem(row, column, item);
      }
    }
    for (const std::string& note : plan->notes) notes << QString::fromStdString(note);
    if (plan->start < plan->begin) {
      notes << QStringLiteral("Warm-up: %1 s from %2 on, not compared.")
                   .arg(numberText(plan->begin - plan->start, 1),
                        QString::fromStdString(secondsToText(plan->start)));
    }
    if (plan->missing.empty()) {
      QStringList names;
      for (const link::RerunProcess& process : plan->processes) {
        names << QString::fromStdString(process.name);
      }
      notes.prepend(
          QStringLiteral("Everything that %1 %2 was recorded.")
              .arg(names.join(names.size() == 2 ? QStringLiteral(" and ") : QStringLiteral(", ")),
                   names.size() == 1 ? QStringLiteral("reads") : QStringLiteral("read")));
    }
    m_notes->setText(notes.join(QLatin1Char('\n')));
    m_recordedAs = plan->recorded;
    QString recorded;
    for (const link::RerunProcess& process : plan->recorded) {
      if (process.name == m_process->currentText().toStdString()) {
        recorded = QString::fromStdString(process.program);
      }
    }
    if (m_unchanged->currentText() == m_proposed) m_unchanged->setEditText(recorded);
    m_proposed = recorded;
    if (!m_started) showMessage({}, false);
  } else {
    m_notes->clear();
    if (!m_started) showMessage(QString::fromStdString(plan.error().message), true);
  }
  m_canRun = plan.has_value();
  showState();
  emit planned();
}

void RerunDialog::start() {
  auto wanted = order();
  if (!wanted) return showMessage(QString::fromStdString(wanted.error().text()), true);
  if (m_check->isChecked()) {
    auto unchanged = unchangedProcesses();
    if (!unchanged) {
      return showMessage(QString::fromStdString(unchanged.error().message), true);
    }
    wanted->unchanged = std::move(*unchanged);
  }
  if (m_parts.settings != nullptr) {
    QStringList recent = m_parts.settings->value(recentProgramsKey).toStringList();
    const auto isOurs = [](const QString& program) {
      return program == ourProgram || link::findBehaviour(program.toStdString()) != nullptr;
    };
    std::vector<const QComboBox*> boxes{m_unchanged};
    for (const Row& row : m_rows) boxes.push_back(row.program);
    boxes.push_back(m_program);
    for (const QComboBox* box : boxes) {
      const QString program = box->currentText().trimmed();
      if (!box->isEnabled() || program.isEmpty() || isOurs(program)) continue;
      recent.removeAll(program);
      recent.prepend(program);
    }
    m_parts.settings->setValue(recentProgramsKey, recent.mid(0, maxRecentPrograms));
  }
  showMessage({}, false);
  m_started = true;
  m_parts.rerunner->start(*wanted);
}

void RerunDialog::showState() {
  const Rerunner& rerunner = *m_parts.rerunner;
  if (m_recording != rerunner.recording()) {
    // It was about another recording.
    if (rerunner.whyNot().isEmpty()) return takeRecording();
    m_started = false;
    hide();
    return;
  }
  const bool running = rerunner.isRunning();
  m_start->setText(running ? QStringLiteral("Cancel") : QStringLiteral("Run"));
  m_start->setEnabled(running || (m_canRun && rerunner.whyNot().isEmpty()));
  m_progress->setVisible(running);
  m_progress->setFormat(rerunner.isChecking() ? QStringLiteral("Checking reproducibility: %p %")
                                              : QStringLiteral("%p %"));
  m_progress->setValue(static_cast<int>(std::lround(100.0 * rerunner.progress())));
  for (QWidget* choice : {static_cast<QWidget*>(m_robot), static_cast<QWidget*>(m_process),
                          static_cast<QWidget*>(m_program), static_cast<QWidget*>(m_browse),
                          static_cast<QWidget*>(m_writes), static_cast<QWidget*>(m_begin),
                          static_cast<QWidget*>(m_end), static_cast<QWidget*>(m_warmUp),
                          static_cast<QWidget*>(m_speed), static_cast<QWidget*>(m_check)}) {
    choice->setEnabled(!running);
  }
  m_unchanged->setEnabled(!running && m_check->isChecked() && !isWholeProfile());
  m_add->setEnabled(!running && !isWholeProfile() &&
                    static_cast<qsizetype>(m_rows.size()) + 1 < processes().size());
  for (const Row& row : m_rows) row.box->setEnabled(!running && !isWholeProfile());
  if (running || !m_started || rerunner.problem().isEmpty() || !isVisible()) return;
  showMessage(rerunner.problem(), true);
  m_started = false;
}

void RerunDialog::showMessage(const QString& sentence, bool bad) {
  QPalette colours = palette();
  if (bad) colours.setColor(QPalette::WindowText, theme().errorText);
  m_message->setPalette(colours);
  m_message->setText(sentence);
  m_message->setVisible(!sentence.isEmpty());
}

void showRerunDialog(const RerunDialogParts& parts, QWidget* window) {
  auto* dialog = window->findChild<RerunDialog*>();
  if (dialog == nullptr) {
    dialog = new RerunDialog(parts, window);
  } else if (!dialog->isVisible()) {
    dialog->takeRecording();
  }
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace pitchboard::ui
