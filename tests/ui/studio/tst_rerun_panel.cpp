// SPDX-License-Identifier: GPL-3.0-or-later
// A recording runs through a program again in the window, with mouse and keys: from the menu to the
// robot beside the original, the list of differences, and the next run when the program changes.

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QTableView>
#include <QTableWidget>
#include <QToolButton>

#include <ui/base/robot_text.h>
#include <ui/plots/plots_dock.h>
#include <ui/rerun/rerun_dialog.h>
#include <ui/rerun/rerunner.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/replay_controller.h>

#include "../support/menu_entry.h"
#include "../support/program_run.h"
#include "differences_model.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "studio_rig.h"

namespace tst_rerun_panel {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 120'000;

QByteArray ballRobot() {
  return contents(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/ball_robot.py"));
}

/// As an editor does it: another file takes its name.
void replaceFile(const QString& path, const QByteArray& text) {
  QFile file(path + QStringLiteral(".new"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  QCOMPARE(file.write(text), text.size());
  file.close();
  QVERIFY(::rename(qPrintable(file.fileName()), qPrintable(path)) == 0);
}

/// The processes of this computer that have this text in their command line.
int processesOf(const QString& text) {
  int count = 0;
  const QStringList entries = QDir(QStringLiteral("/proc")).entryList(QDir::Dirs);
  for (const QString& entry : entries) {
    if (contents(QStringLiteral("/proc/%1/cmdline").arg(entry)).contains(text.toUtf8())) ++count;
  }
  return count;
}

struct Panel : studio_rig::Studio {
  QDockWidget* dock = window.findChild<QDockWidget*>(QStringLiteral("rerun"));
  Rerunner* rerunner = window.findChild<Rerunner*>();
  RerunDialog* dialog = nullptr;

  Panel() { rerunner->setRobotProgram(PITCHBOARD_BIN "/pitchboard-robot"); }
  QAction* entry() { return menu_entry::downFrom(window.menuBar(), {"Timeline", "Rerun with…"}); }
  void open(const QString& session) {
    window.openSession(session);
    QTRY_VERIFY_WITH_TIMEOUT(window.shown()->source() == window.replay() &&
                                 window.replay()->path() == session &&
                                 window.replay()->loaded() >= 1.0,
                             patience_ms);
  }
  void ask() {
    QVERIFY2(entry()->isEnabled(), qPrintable(entry()->toolTip()));
    entry()->trigger();
    dialog = window.findChild<RerunDialog*>();
    QVERIFY(dialog != nullptr && dialog->isVisible());
  }
  template <class Widget>
  Widget* find(const char* name) const {
    auto* found = dialog->findChild<Widget*>(QLatin1String(name));
    if (found == nullptr) found = dock->findChild<Widget*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  void click(const char* name) const { QTest::mouseClick(find<QPushButton>(name), Qt::LeftButton); }
  void type(const char* name, const QString& text) const {
    auto* box = find<QComboBox>(name);
    box->lineEdit()->selectAll();
    QTest::keyClicks(box->lineEdit(), text);
  }
  QString message() const { return find<QLabel>("rerunMessage")->text(); }
  void run(const QString& program) {
    ask();
    type("rerunProgram", program);
    QSignalSpy finished(rerunner, &Rerunner::finished);
    click("rerunStart");
    QVERIFY2(rerunner->isRunning(), qPrintable(message()));
    QTRY_VERIFY2_WITH_TIMEOUT(!finished.isEmpty(), qPrintable(rerunner->problem()), patience_ms);
    QTRY_VERIFY_WITH_TIMEOUT(window.replay()->path() != window.replay()->recording(), patience_ms);
  }
  bool hasRobot(const std::string& name) const {
    const auto groups = window.replay()->groups();
    return std::ranges::any_of(groups, [&name](const auto& group) { return group.name == name; });
  }
  QStringList curves() const {
    QStringList all;
    for (const PlotPage* page : window.findChild<PlotsDock*>()->pages()) {
      for (const PlotPane* pane : page->panes()) {
        for (const Curve& curve : pane->curves()) all << curve.spec().inputs;
      }
    }
    return all;
  }
  /// Of the card of a robot.
  QString subtitle(const char* robot) const {
    for (const RobotCard* card : window.findChild<RobotsDock*>()->cards()) {
      if (card->state().name == QLatin1String(robot)) return card->state().subtitle;
    }
    return QStringLiteral("no card");
  }
  QTableView* list() const { return dock->findChild<QTableView*>(QStringLiteral("differences")); }
  QString state() const { return dock->findChild<QLabel*>(QStringLiteral("rerunState"))->text(); }
};

}  // namespace

class TestRerunPanel : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_ours, m_team;  // recordings: our processes, and ball_robot.py

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  QString program(const char* name, const QByteArray& text) const {
    replaceFile(path(name), text);
    return path(name);
  }
  static QByteArray changed() {
    QByteArray text = ballRobot();
    return text.replace("KICK_DISTANCE = 25", "KICK_DISTANCE = 35");
  }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    m_ours = path("ours.mcap");
    ProgramRun run = cli({"record", "--scenario", "one-robot", "--noise", "realistic", "--seed",
                          "7", "--speed", "max", "--duration", "12", "-o", m_ours});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    program("profile.json",
            R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [
      {"name": "decision", "command": ["python3", ")" +
                program("ball_robot.py", ballRobot()).toUtf8() + R"(", "${key}"]}]})");
    m_team = path("team.mcap");
    run = cli({"record", "--scenario", "one-robot", "--noise", "realistic", "--seed", "7",
               "--runtime", "B1=" + path("profile.json"), "--speed", "max", "--duration", "40",
               "-o", m_team});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void itIsGreyWithAReason() {
    Panel s;
    QVERIFY(!s.entry()->isEnabled());
    QCOMPARE(s.entry()->toolTip(), QStringLiteral("Only in Replay"));
    s.window.showSource(SourceKind::Replay);
    QVERIFY(!s.entry()->isEnabled());
    QCOMPARE(s.entry()->toolTip(), QStringLiteral("Open a recording first"));
    s.open(m_ours);
    QVERIFY(s.entry()->isEnabled());
    s.window.showSource(SourceKind::Simulate);
    QCOMPARE(s.entry()->toolTip(), QStringLiteral("Only in Replay"));
  }

  void theDialogKnowsWhatIsSelectedAndTellsWhatWillHappen() {
    Panel s;
    s.open(m_ours);
    s.window.shown()->setSelection(telemetry::TimeRange{2.0, 4.5});
    s.ask();
    QCOMPARE(s.find<QComboBox>("rerunRobot")->currentText(), QStringLiteral("B1"));
    QCOMPARE(s.find<QComboBox>("rerunProcess")->currentText(), QStringLiteral("decision"));
    QCOMPARE(s.find<QComboBox>("rerunProgram")->currentText(), QStringLiteral("reference"));
    QCOMPARE(s.find<QLineEdit>("rerunBegin")->text(), QStringLiteral("0:02"));
    QCOMPARE(s.find<QLineEdit>("rerunEnd")->text(), QStringLiteral("0:04.5"));
    auto* outputs = s.find<QTableWidget>("rerunOutputs");
    QTRY_VERIFY(outputs->rowCount() > 0);
    const auto action = outputs->findItems(QStringLiteral("DECISION_ACTION_A"), Qt::MatchExactly);
    QCOMPARE(action.size(), 1);
    QCOMPARE(outputs->item(action.front()->row(), 1)->text(), QStringLiteral("Map of variables"));
    QCOMPARE(outputs->item(action.front()->row(), 2)->text(), QStringLiteral("yes"));
    QVERIFY2(s.find<QLabel>("rerunNotes")->text().contains(QStringLiteral("was recorded")),
             qPrintable(s.find<QLabel>("rerunNotes")->text()));
    const auto begins = [outputs](const char* text) {
      return outputs->findItems(QLatin1String(text), Qt::MatchStartsWith).size();
    };
    QCOMPARE(begins("IMU_"), qsizetype(1));  // IMU_RESET
    // More variables, and another process.
    QTest::keyClicks(s.find<QLineEdit>("rerunWrites"), QStringLiteral("IMU_*"));
    QTRY_VERIFY(begins("IMU_") > 1);
    s.find<QLineEdit>("rerunWrites")->clear();
    s.find<QComboBox>("rerunProcess")->setCurrentText(QStringLiteral("localization"));
    QTRY_VERIFY(begins("DECISION_ACTION") == 0 && begins("LOCALIZATION_") > 0);

    // Without a range: between the marks, or everything.
    QTest::keyClick(s.dialog, Qt::Key_Escape);
    QVERIFY(!s.dialog->isVisible());
    s.window.shown()->setSelection({});
    s.window.shown()->setMarks({7.0, 5.0});
    s.ask();
    QCOMPARE(s.find<QLineEdit>("rerunBegin")->text(), QStringLiteral("0:05"));
    QCOMPARE(s.find<QLineEdit>("rerunEnd")->text(), QStringLiteral("0:07"));
    s.dialog->close();
    s.window.shown()->setMarks({});
    s.ask();
    QCOMPARE(s.find<QLineEdit>("rerunBegin")->text(), QString());
  }

  void ourUnchangedDecisionGivesTheSame() {
    Panel s;
    s.open(m_ours);
    s.window.shown()->seek(3.0);
    s.window.shown()->setSelection(telemetry::TimeRange{1.0, 8.0});
    s.ask();
    QSignalSpy finished(s.rerunner, &Rerunner::finished);
    s.click("rerunStart");
    QVERIFY(s.rerunner->isRunning());
    QVERIFY(s.find<QProgressBar>("rerunProgress")->isVisible());
    QTRY_VERIFY2_WITH_TIMEOUT(!finished.isEmpty(), qPrintable(s.rerunner->problem()), patience_ms);
    QVERIFY(!s.dialog->isVisible());
    QVERIFY(s.dock->isVisible());
    const auto result = s.rerunner->result();
    QVERIFY(result && result->inLockStep && result->compared() > 1000);
    QCOMPARE(result->unequal(), std::uint64_t(0));
    QCOMPARE(result->begin, 1.0);
    QCOMPARE(result->end, 8.0);
    QCOMPARE(s.list()->model()->rowCount(), 0);
    QVERIFY(s.dock->findChild<QLabel*>(QStringLiteral("emptyRerun"))->isVisible());
    QVERIFY2(s.state().contains(QStringLiteral("no difference")), qPrintable(s.state()));

    // The robot beside the original: on the field, with its rows, and in the plots.
    QTRY_VERIFY_WITH_TIMEOUT(s.hasRobot("B1 rerun"), patience_ms);
    QVERIFY(s.hasRobot("B1"));
    QTRY_VERIFY(s.window.shown()->frame() && s.window.shown()->frame()->robots.size() == 2);
    // Two names on the field, where one stands on the other.
    QStringList names;
    for (const link::RobotFrame& robot : s.window.shown()->frame()->robots)
      names << robotName(robot);
    names.sort();
    QCOMPARE(names, QStringList({QStringLiteral("B1"), QStringLiteral("B1 rerun")}));
    QCOMPARE(s.subtitle("B1 rerun"), QStringLiteral("Striker"));
    QCOMPARE(s.window.shown()->time(), 3.0);
    QVERIFY(s.window.shown()->selection() == (telemetry::TimeRange{1.0, 8.0}));
    QCOMPARE(s.window.replay()->recording(), m_ours);
    QVERIFY2(s.window.windowTitle().startsWith(QStringLiteral("ours.mcap with a rerun")),
             qPrintable(s.window.windowTitle()));
    QTRY_VERIFY2_WITH_TIMEOUT(s.curves().contains(QStringLiteral("B1 rerun/DECISION_ACTION_A")),
                              qPrintable(s.curves().join(QLatin1Char(' '))), patience_ms);
    QCOMPARE(s.window.recentSessions().value(0), m_ours);
    // A bookmark belongs to the recording.
    s.window.shown()->addBookmark(QStringLiteral("here"));
    QVERIFY(QFile::exists(m_ours + QStringLiteral(".notes.json")));
    // The original can run again: the rerun is no robot of the recording.
    s.ask();
    QCOMPARE(s.find<QComboBox>("rerunRobot")->findText(QStringLiteral("B1 rerun")), -1);
  }

  void severalProcessesRunAtOnce() {
    Panel s;
    s.open(m_ours);
    s.window.shown()->setSelection(telemetry::TimeRange{1.0, 8.0});
    s.ask();
    auto* outputs = s.find<QTableWidget>("rerunOutputs");
    const auto begins = [outputs](const char* text) {
      return outputs->findItems(QLatin1String(text), Qt::MatchStartsWith).size();
    };
    QTRY_VERIFY(begins("DECISION_ACTION") > 0 && begins("LOCALIZATION_X") == 0);
    s.click("rerunAddProcess");
    auto* second = s.find<QComboBox>("rerunMoreProcess");
    QVERIFY(second->currentText() != QStringLiteral("decision"));
    second->setCurrentText(QStringLiteral("localization"));
    QCOMPARE(s.find<QComboBox>("rerunMoreProgram")->currentText(), QStringLiteral("reference"));
    QTRY_VERIFY(begins("DECISION_ACTION") > 0 && begins("LOCALIZATION_X") > 0);
    QVERIFY2(s.find<QLabel>("rerunNotes")
                 ->text()
                 .contains(QStringLiteral("Everything that decision and localization read")),
             qPrintable(s.find<QLabel>("rerunNotes")->text()));
    // The same process twice is refused before it runs.
    second->setCurrentText(QStringLiteral("decision"));
    QTRY_VERIFY2(s.message().contains(QStringLiteral("twice")), qPrintable(s.message()));
    QVERIFY(!s.find<QPushButton>("rerunStart")->isEnabled());
    second->setCurrentText(QStringLiteral("localization"));
    QTRY_VERIFY(s.message().isEmpty() && s.find<QPushButton>("rerunStart")->isEnabled());
    // With the check of reproducibility, both run unchanged first.
    auto* check = s.find<QCheckBox>("rerunCheck");
    QTest::mouseClick(check, Qt::LeftButton, {}, {8, check->height() / 2});
    QSignalSpy finished(s.rerunner, &Rerunner::finished);
    s.click("rerunStart");
    QTRY_VERIFY2_WITH_TIMEOUT(!finished.isEmpty(), qPrintable(s.rerunner->problem() + s.message()),
                              patience_ms);
    const auto result = s.rerunner->result();
    QCOMPARE(result->processes, (std::vector<link::RerunProcess>{{"decision", "reference"},
                                                                 {"localization", "reference"}}));
    QCOMPARE(result->unequal(), std::uint64_t(0));
    QVERIFY(QFile::exists(path("ours.B1-decision-localization.same.json")));
    // It can be taken away again.
    s.ask();
    QTest::mouseClick(s.find<QToolButton>("rerunRemoveProcess"), Qt::LeftButton);
    QTRY_VERIFY(s.dialog->findChild<QComboBox*>(QStringLiteral("rerunMoreProcess")) == nullptr);
    QTRY_VERIFY(begins("DECISION_ACTION") > 0 && begins("LOCALIZATION_X") == 0);
  }

  /// What of it cannot run is said before it starts.
  void aWholeProfileRuns() {
    Panel s;
    s.open(m_ours);
    s.window.shown()->setSelection(telemetry::TimeRange{1.0, 6.0});
    s.ask();
    s.find<QComboBox>("rerunProcess")->setCurrentText(QStringLiteral("All of a profile"));
    QVERIFY(!s.find<QPushButton>("rerunAddProcess")->isEnabled());
    s.type("rerunProgram", QStringLiteral("reference"));
    auto* notes = s.find<QLabel>("rerunNotes");
    QTRY_VERIFY2(notes->text().contains(QStringLiteral("communication also gets")),
                 qPrintable(notes->text()));
    QVERIFY2(notes->text().contains(QStringLiteral("team also gets messages of team-mates")),
             qPrintable(notes->text()));
    QSignalSpy finished(s.rerunner, &Rerunner::finished);
    s.click("rerunStart");
    QTRY_VERIFY2_WITH_TIMEOUT(!finished.isEmpty(), qPrintable(s.rerunner->problem()), patience_ms);
    const auto result = s.rerunner->result();
    QVERIFY(result->processes.size() >= 2 && result->unequal() == 0);
    s.run(path("profile.json"));
    QCOMPARE(s.rerunner->result()->processes,
             (std::vector<link::RerunProcess>{{"decision", path("profile.json").toStdString()}}));
  }

  void aChangedProgramGivesAListThatLeadsToTheMoments() {
    Panel s;
    s.open(m_team);
    // Who decided, in the recording and in the rerun.
    QTRY_COMPARE(s.subtitle("B1"), QStringLiteral("ball_robot.py"));
    s.run(program("changed.py", changed()));
    QTRY_COMPARE_WITH_TIMEOUT(s.subtitle("B1 rerun"), QStringLiteral("changed.py"), patience_ms);
    QCOMPARE(s.subtitle("B1"), QStringLiteral("ball_robot.py"));
    const auto result = s.rerunner->result();
    QVERIFY(result && result->stretches() > 0);
    QTableView* list = s.list();
    QVERIFY(list->isVisible());
    QCOMPARE(std::uint64_t(list->model()->rowCount()), result->stretches());
    QVERIFY(s.state().contains(QStringLiteral("difference")));
    // The list leads to the moments.
    const QModelIndex last = list->model()->index(list->model()->rowCount() - 1, 0);
    list->scrollTo(last);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(last).center());
    QCOMPARE(s.window.shown()->time(), last.data(DifferencesModel::timeRole).toDouble());
    QTest::keyClick(list, Qt::Key_Home, Qt::ControlModifier);
    QTest::keyClick(list, Qt::Key_Return);
    QCOMPARE(s.window.shown()->time(),
             list->model()->index(0, 0).data(DifferencesModel::timeRole).toDouble());
    // They are events, too.
    const auto& events = s.window.shown()->events()->events();
    const auto marked =
        std::ranges::count(events, link::MatchEventKind::RerunDiffers, &link::MatchEvent::kind);
    QCOMPARE(std::uint64_t(marked), result->stretches());
    // Filtered by words.
    auto* words = s.find<QLineEdit>("rerunFilter");
    QTest::keyClicks(words, QStringLiteral("no such words"));
    QCOMPARE(list->model()->rowCount(), 0);
    words->clear();
    const QString report = path("report.html");
    QVERIFY(s.rerunner->writeReport(report));
    QVERIFY(contents(report).contains("DECISION_ACTION_A"));

    // The same again: nothing has changed since.
    QSignalSpy finished(s.rerunner, &Rerunner::finished);
    s.click("rerunAgain");
    QTRY_VERIFY_WITH_TIMEOUT(finished.size() == 1, patience_ms);
    QVERIFY(s.rerunner->result()->sinceLast.has_value());
    QVERIFY2(s.state().contains(QStringLiteral("Since the last run: no difference")),
             qPrintable(s.state()));
    QCOMPARE(s.find<QComboBox>("rerunFrom")->currentIndex(), 1);
    QCOMPARE(list->model()->rowCount(), 0);

    // The program changes back: it runs by itself, and the differences are gone since.
    auto* follow = s.find<QCheckBox>("rerunFollow");
    QVERIFY2(follow->isEnabled(), qPrintable(follow->toolTip()));
    QTest::mouseClick(follow, Qt::LeftButton, {}, {8, follow->height() / 2});
    QVERIFY(follow->isChecked());
    program("changed.py", ballRobot());
    QTRY_VERIFY_WITH_TIMEOUT(finished.size() == 2, patience_ms);
    QCOMPARE(s.rerunner->result()->unequal(), std::uint64_t(0));
    QVERIFY(list->model()->rowCount() > 0);
    // A program that breaks is reported, and what there was stays.
    program("changed.py", "import sys\nsys.exit('no idea')\n");
    QTRY_VERIFY_WITH_TIMEOUT(s.rerunner->problem().contains(QStringLiteral("no idea")),
                             patience_ms);
    QVERIFY(s.rerunner->result() != nullptr && s.rerunner->isFollowing());
    program("changed.py", changed());
    QTRY_VERIFY_WITH_TIMEOUT(finished.size() == 3, patience_ms);
    QVERIFY(s.rerunner->problem().isEmpty());
    QVERIFY(s.rerunner->result()->stretches() > 0);

    // Another recording forgets it.
    s.open(m_ours);
    QVERIFY(s.rerunner->result() == nullptr && !s.rerunner->isFollowing());
    QCOMPARE(list->model()->rowCount(), 0);
  }

  void whatDiffersUnchangedIsLeftOut() {
    Panel s;
    s.open(m_team);
    QByteArray random = ballRobot();
    random.replace("import sys\n", "import random\nimport sys\n");
    random.replace("    if tick % 6 == 0:",
                   "    ints[19] = random.randrange(1000000)\n    if tick % 6 == 0:");
    const QString file = program("chance.py", random);
    s.ask();
    s.type("rerunProgram", file);
    QTest::mouseClick(s.find<QCheckBox>("rerunCheck"), Qt::LeftButton, {}, {8, 8});
    QVERIFY(s.find<QComboBox>("rerunUnchanged")->isEnabled());
    // What was recorded is offered.
    QTRY_VERIFY2_WITH_TIMEOUT(
        s.find<QComboBox>("rerunUnchanged")->currentText() == path("profile.json"),
        qPrintable(s.find<QComboBox>("rerunUnchanged")->currentText() + s.message()), 30'000);
    s.type("rerunUnchanged", file);
    QSignalSpy finished(s.rerunner, &Rerunner::finished);
    s.click("rerunStart");
    QVERIFY2(s.rerunner->isChecking(), qPrintable(s.message()));
    QTRY_VERIFY2_WITH_TIMEOUT(!finished.isEmpty(), qPrintable(s.rerunner->problem()), patience_ms);
    QCOMPARE(s.rerunner->result()->stretches(), std::uint64_t(0));
    QVERIFY(s.rerunner->result()->unchangedToo() > 0);
    QVERIFY2(s.state().contains(QStringLiteral("DECISION_STATE")), qPrintable(s.state()));
    QVERIFY(QFile::remove(path("team.B1-decision.same.json")));
  }

  void mistakesAreSentencesInTheDialog() {
    Panel s;
    s.open(m_ours);
    s.ask();
    s.type("rerunProgram", QStringLiteral("/no/such/decide.py"));
    QSignalSpy planned(s.dialog, &RerunDialog::planned);
    QTRY_VERIFY(!planned.isEmpty());  // before it is started, too
    QVERIFY2(s.message().contains(QStringLiteral("/no/such/decide.py")), qPrintable(s.message()));
    s.click("rerunStart");
    QTRY_VERIFY_WITH_TIMEOUT(!s.rerunner->isRunning(), patience_ms);
    QTRY_VERIFY2(s.message().contains(QStringLiteral("/no/such/decide.py")),
                 qPrintable(s.message()));
    QVERIFY(s.dialog->isVisible());
    QVERIFY(s.rerunner->result() == nullptr);
    QTest::keyClicks(s.find<QLineEdit>("rerunBegin"), QStringLiteral("soon"));
    s.click("rerunStart");
    QVERIFY(!s.rerunner->isRunning());
    QVERIFY2(s.message().contains(QStringLiteral("soon")), qPrintable(s.message()));
    s.find<QLineEdit>("rerunBegin")->clear();
    // One that ends at once.
    s.type("rerunProgram", QStringLiteral("sh -c \"exit 3\""));
    s.click("rerunStart");
    QTRY_VERIFY2_WITH_TIMEOUT(s.message().contains(QStringLiteral("exit code")),
                              qPrintable(s.message()), patience_ms);
  }

  void cancelEndsTheProgram() {
    Panel s;
    s.open(m_team);
    const QString file = program("cancelled.py", ballRobot());
    s.ask();
    s.type("rerunProgram", file);
    s.find<QComboBox>("rerunSpeed")->setCurrentText(QStringLiteral("×0.5"));
    s.click("rerunStart");
    QTRY_VERIFY_WITH_TIMEOUT(processesOf(file) > 0, patience_ms);
    QCOMPARE(s.find<QPushButton>("rerunStart")->text(), QStringLiteral("Cancel"));
    s.click("rerunStart");
    QVERIFY(!s.rerunner->isRunning());
    QCOMPARE(s.message(), QStringLiteral("Cancelled."));
    QCOMPARE(s.find<QPushButton>("rerunStart")->text(), QStringLiteral("Run"));
    QTRY_COMPARE_WITH_TIMEOUT(processesOf(file), 0, patience_ms);
    QVERIFY(s.rerunner->result() == nullptr);
  }

  void closingTheWindowEndsTheProgram() {
    const QString file = program("closed.py", ballRobot());
    {
      Panel s;
      s.open(m_team);
      s.ask();
      s.type("rerunProgram", file);
      s.find<QComboBox>("rerunSpeed")->setCurrentText(QStringLiteral("×0.5"));
      s.click("rerunStart");
      QTRY_VERIFY_WITH_TIMEOUT(processesOf(file) > 0, patience_ms);
      s.window.close();
      auto* asked = s.window.findChild<QMessageBox*>(QStringLiteral("askToClose"));
      QVERIFY(asked != nullptr && s.window.isVisible());
      QVERIFY2(asked->text().contains(QStringLiteral("A rerun is running")),
               qPrintable(asked->text()));
      QTest::mouseClick(asked->findChild<QPushButton*>(QStringLiteral("quitNow")), Qt::LeftButton);
      QTRY_VERIFY(!s.window.isVisible());
    }
    QTRY_COMPARE(processesOf(file), 0);
  }

  void tenThousandDifferencesAreAList() {
    std::vector<link::ComparedVariable> variables(12);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      variables[i].column.name = "V" + std::to_string(i);
      for (int k = 0; k < 1000; ++k) {
        variables[i].stretches.push_back({k + 0.05 * double(i), k + 0.9, 1.0, 2.0, 1.0});
      }
      variables[i].stretchCount = 1500;  // more than are kept
    }
    DifferencesModel model;
    model.show(variables, QStringLiteral("Recorded"), {});
    QCOMPARE(model.rowCount(), 12'000);
    QCOMPARE(model.all(), std::uint64_t(18'000));
    double before = -1.0;
    for (int row = 0; row < model.rowCount(); ++row) {
      const double time = model.index(row, 0).data(DifferencesModel::timeRole).toDouble();
      QVERIFY(time >= before);
      before = time;
    }
    QCOMPARE(model.index(1, DifferencesModel::Variable).data().toString(), QStringLiteral("V1"));
    QCOMPARE(model.index(1, DifferencesModel::Before).data().toString(), QStringLiteral("1"));
    QCOMPARE(model.index(1, DifferencesModel::Rerun).data().toString(), QStringLiteral("2"));
  }
};

PITCHBOARD_GUI_TEST(TestRerunPanel)

}  // namespace tst_rerun_panel

#include "tst_rerun_panel.moc"
