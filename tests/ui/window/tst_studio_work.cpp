// SPDX-License-Identifier: GPL-3.0-or-later
// What the window does to the match behind it: opening without waiting, notices with buttons,
// processes, noise, two studios on one key base, and the same numbers as the command line.
#include <unistd.h>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QHelpEvent>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QMenu>
#include <QProcess>
#include <QPushButton>
#include <QSemaphore>
#include <QSettings>
#include <QSignalSpy>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolTip>
#include <QtTest>

#include <robotlink/blackboard/system_v.h>
#include <ui/base/notice_bar.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>
#include <ui/robots/robot_card.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

#include "../support/menu_entry.h"
#include "../support/real_time_robot.h"
#include "../support/segment_keys.h"
#include "../support/setuid_program.h"
#include "studio_rig.h"

namespace tst_studio_work {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestStudioWork : public QObject {
  Q_OBJECT

  int m_keyBase = testKeyBase();

  static link::Scenario match() { return link::loadScenario("match-3v3").value(); }
  link::MatchOptions options(link::Cognition cognition) const {
    link::MatchOptions made;
    made.cognition = cognition;
    made.keyBase = m_keyBase;
    made.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    return made;
  }
  struct Studio : studio_rig::Studio {
    using studio_rig::Studio::Studio;
    QPushButton* noticeButton(const QString& text) {
      for (auto* button : window.notices()->findChildren<QPushButton*>()) {
        if (button->text() == text && button->isVisible()) return button;
      }
      return nullptr;
    }
    link::ProcessStatus child(int robot, const std::string& name) {
      link::ProcessStatus newest;
      if (!controller.frame()) return newest;
      const link::RobotFrame* seen = controller.frame()->robot(RobotId{robot});
      if (seen == nullptr) return newest;
      for (const link::ProcessStatus& status : seen->processes()) {
        if (status.name == name) newest = status;
      }
      return newest;
    }
  };

  // A segment whose creator is gone, as after a studio that was killed.
  void leaveOrphan(int key) {
    QCOMPARE(QProcess::execute(QStringLiteral(SEGMENT_USER),
                               {QStringLiteral("leave"), QString::number(key)}),
             0);
  }
  // Opens the context menu of the processes table there and takes the entry.
  static void chooseInProcesses(Studio& s, const QString& starts, bool& chosen, const QPoint& at) {
    auto* table = s.window.findChild<QTableView*>(QStringLiteral("processesTable"));
    QTimer::singleShot(0, table, [&chosen, starts] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (!menu) return;
      QAction* entry = menu_entry::beginning(menu->actions(), starts);
      if (entry != nullptr && entry->isEnabled()) {
        chosen = true;
        entry->trigger();
      }
      menu->close();
    });
    emit table->customContextMenuRequested(at);
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }
  void cleanup() {
    for (const auto& segment : link::SystemVSegments::list(m_keyBase)) {
      (void)link::SystemVSegments::remove(segment.key);
    }
  }

  void openingDoesNotKeepTheWindowWaiting() {
    Studio s(options(link::Cognition::Inline));
    s.controller.open(match(), true);
    QTRY_VERIFY(s.controller.frame());
    // The worker stands until we let it go on; the window lives meanwhile.
    QSemaphore gate;
    s.controller.restart([&gate] { gate.acquire(); });
    QVERIFY(!s.controller.frame());
    QVERIFY(s.controller.isOpening());
    auto* label = s.window.findChild<QLabel*>(QStringLiteral("openingLabel"));
    QTRY_VERIFY(label->isVisible());
    QTRY_VERIFY(s.window.findChild<QLabel*>(QStringLiteral("noRobots"))->isVisible());
    QVERIFY(s.window.findChild<QLabel*>(QStringLiteral("noRobots"))
                ->text()
                .startsWith(QStringLiteral("Opening")));
    sim::NoiseParameters noise;
    noise.forward = 0.25;
    s.controller.edits()->setNoise(noise);  // reaches the match once it is there
    gate.release();
    QTRY_VERIFY(s.controller.frame());
    QTRY_COMPARE(s.controller.frame()->settings->noise.forward, 0.25);
    QVERIFY(!label->isVisible());
  }

  void aNewerOpenSupersedes() {
    MatchController c(options(link::Cognition::Inline));
    QSignalSpy opened(&c, &MatchController::opened);
    QSemaphore gate;
    c.open(match(), true);
    c.restart([&gate] { gate.acquire(); });
    link::Scenario bad = match();
    bad.settings.physics = "no-such-model";
    c.open(bad, true);
    c.open(link::loadScenario("one-robot").value(), true);
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    gate.release();
    QTRY_VERIFY(c.frame());
    QCOMPARE(c.frame()->robots.size(), std::size_t(1));
    QCOMPARE(opened.count(), 1);
    QCOMPARE(errors.count(), 0);
  }

  void closingWhileOpeningLeavesNothing() {
    {
      MatchController c(options(link::Cognition::Separate));
      c.open(match());
      c.close();
      QVERIFY(!c.isOpening());
      c.open(match());
    }
    QVERIFY(link::SystemVSegments::list(m_keyBase).empty());
  }

  void removeTakesTheOrphanAwayAndKeepKeepsIt_data() {
    QTest::addColumn<QString>("button");
    QTest::addColumn<bool>("stays");
    QTest::newRow("remove") << QStringLiteral("Remove") << false;
    QTest::newRow("keep") << QStringLiteral("Keep") << true;
  }
  void removeTakesTheOrphanAwayAndKeepKeepsIt() {
    QFETCH(QString, button);
    QFETCH(bool, stays);
    const int key = m_keyBase + 100 * 40;  // no robot of the match has it
    leaveOrphan(key);
    Studio s(options(link::Cognition::None));
    s.window.offerToRemoveOrphans();
    s.controller.open(match(), true);
    QTRY_VERIFY(s.controller.frame());
    QVERIFY(s.window.notices()->text().contains(QString::number(key)));
    QVERIFY(s.noticeButton(button));
    QTest::mouseClick(s.noticeButton(button), Qt::LeftButton);
    QVERIFY(!s.window.notices()->text().contains(QString::number(key)));
    QTRY_VERIFY(s.controller.frame());
    QCOMPARE(link::SystemVSegments::info(key).has_value(), stays);
  }

  void theProcessesMenuRestartsAndStops() {
    Studio s(options(link::Cognition::Separate));
    s.controller.open(match());
    QTRY_VERIFY_WITH_TIMEOUT(s.child(1, "communication").pid > 0, 20000);
    const link::ProcessStatus first = s.child(1, "decision");
    QVERIFY(first.pid > 0);
    auto* table = s.window.findChild<QTableView*>(QStringLiteral("processesTable"));
    QTRY_VERIFY(table->isVisible() && table->model()->rowCount() > 0);
    // The row of a process decides what the entries of its menu do.
    const auto clickNow = [&](const QString& entry) {
      for (int row = 0; row < table->model()->rowCount(); ++row) {
        const QModelIndex name = table->model()->index(row, 1);
        if (name.data().toString() != QStringLiteral("decision")) continue;
        if (name.siblingAtColumn(0).data().toString() != QStringLiteral("B1")) continue;
        bool chosen = false;
        chooseInProcesses(s, entry, chosen, table->visualRect(name).center());
        return chosen;
      }
      return false;
    };
    // The table follows the match some moments later.
    const auto click = [&](const QString& entry) {
      return QTest::qWaitFor([&] { return clickNow(entry); });
    };
    QVERIFY(click(QStringLiteral("Restart decision of B1")));
    QTRY_VERIFY(s.child(1, "decision").restarts == 1);
    QTRY_COMPARE(s.child(1, "decision").state, link::ProcessState::Running);
    QVERIFY(s.child(1, "decision").pid != first.pid);
    QVERIFY(click(QStringLiteral("Stop decision of B1")));
    QTRY_COMPARE(s.child(1, "decision").state, link::ProcessState::Stopped);
    QCOMPARE(s.child(1, "communication").state, link::ProcessState::Running);
    QVERIFY(click(QStringLiteral("Start decision of B1")));
    QTRY_COMPARE(s.child(1, "decision").state, link::ProcessState::Running);
    QVERIFY(click(QStringLiteral("Kill decision of B1")));
    QTRY_COMPARE(s.child(1, "decision").restarts, 2);
  }

  void noiseSetInTheDockReachesTheSimulation() {
    Studio s(options(link::Cognition::Inline));
    s.controller.open(match(), true);
    QTRY_VERIFY(s.controller.frame());
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("noise"));
    dock->show();
    const auto box = [dock](const char* name) -> QDoubleSpinBox* {
      for (auto* spin : dock->findChildren<QDoubleSpinBox*>()) {
        if (spin->accessibleName() == QLatin1String(name)) return spin;
      }
      return nullptr;
    };
    QVERIFY(box("Forward"));
    box("Forward")->setFocus();
    box("Forward")->selectAll();
    QTest::keyClicks(box("Forward"), QStringLiteral("1.25"));
    QTest::keyClick(box("Forward"), Qt::Key_Return);
    QTRY_COMPARE(s.controller.frame()->settings->noise.forward, 0.0125);
    auto* preset = dock->findChild<QComboBox*>(QStringLiteral("noisePreset"));
    QCOMPARE(preset->currentText(), QStringLiteral("custom"));
    const int none = preset->findText(QStringLiteral("none"));
    preset->setCurrentIndex(none);
    emit preset->activated(none);
    QTRY_COMPARE(s.controller.frame()->settings->noise, link::noisePreset("none").value());
    auto* model = dock->findChild<QComboBox*>(QStringLiteral("physicsModel"));
    const int published = model->findData(QStringLiteral("published"));
    QVERIFY(published >= 0);
    model->setCurrentIndex(published);
    emit model->activated(published);
    QTRY_COMPARE(s.controller.frame() ? s.controller.frame()->settings->physics : std::string(),
                 std::string("published"));
  }

  void aSecondStudioOnTheSameKeysPlaysInside() {
    Studio first(options(link::Cognition::None));
    first.controller.open(match(), true);
    QTRY_VERIFY(first.controller.frame());
    Studio second(options(link::Cognition::None));
    second.controller.open(match(), true);
    QTRY_VERIFY(second.controller.frame());
    QCOMPARE(first.controller.cognition(), link::Cognition::None);
    QCOMPARE(second.controller.cognition(), link::Cognition::Inline);
    QVERIFY(second.window.notices()->isVisible());
    QVERIFY2(second.window.notices()->text().contains(QStringLiteral("run inside the studio")),
             qPrintable(second.window.notices()->text()));
    QVERIFY(second.window.findChild<QLabel*>(QStringLiteral("noProcesses"))
                ->text()
                .contains(QStringLiteral("could not be started")));
    QCOMPARE(link::SystemVSegments::list(m_keyBase).size(), std::size_t(6));
  }

  void theWindowAndTheCommandLineGiveTheSameHash() {
    QProcess cli;
    cli.start(QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
              QStringLiteral("simulate --scenario match-3v3 --seed 7 --duration 60 --json")
                  .split(QLatin1Char(' ')));
    QVERIFY(cli.waitForFinished(30000));
    const QJsonObject outcome = QJsonDocument::fromJson(cli.readAllStandardOutput()).object();
    const auto tick = static_cast<std::uint64_t>(outcome[QLatin1String("ticks")].toInteger());
    QVERIFY(tick > 0);

    Studio s(options(link::Cognition::Inline));
    link::Scenario scenario = match();
    scenario.settings.seed = 7;
    s.controller.open(scenario);
    s.controller.runTo(tick);
    QTRY_VERIFY_WITH_TIMEOUT(s.controller.frame() && s.controller.frame()->snapshot.tick == tick,
                             30000);
    QCOMPARE(QStringLiteral("0x%1").arg(s.controller.stateHash(), 16, 16, QLatin1Char('0')),
             outcome[QLatin1String("state_hash")].toString());
    QTRY_VERIFY(s.controller.frame()->paused);
  }

  void aChangeOfSpeedAsksAboutProgramsInRealTime() {
    Studio s(options(link::Cognition::Inline));
    s.controller.open(realTimeRobot(s.folder));
    QTRY_VERIFY(s.child(1, "decision").pid != 0);
    const int first = s.child(1, "decision").pid;
    s.controller.setSpeed(8.0);
    QCOMPARE(s.window.notices()->text(),
             QStringLiteral(
                 "B1 decision uses real time (\"clock\": \"real\") and cannot follow \u00d78."));
    QVERIFY(s.noticeButton(QStringLiteral("Change speed only for the others")));
    QTest::mouseClick(s.noticeButton(QStringLiteral("Stay at \u00d71")), Qt::LeftButton);
    QVERIFY(s.window.notices()->text().isEmpty());
    QCOMPARE(s.controller.speed(), 1.0);
    s.controller.setSpeed(link::MatchRunner::unlimitedSpeed);
    QVERIFY(s.window.notices()->text().endsWith(QStringLiteral("cannot follow maximum speed.")));
    QTest::mouseClick(s.noticeButton(QStringLiteral("Restart with match time")), Qt::LeftButton);
    QTRY_VERIFY(s.child(1, "decision").pid != 0 && s.child(1, "decision").pid != first);
    QCOMPARE(s.controller.speed(), link::MatchRunner::unlimitedSpeed);
    QCOMPARE(s.child(1, "decision").clock, link::ProcessClock::Match);
  }

  // The match's clock cannot be loaded into it: its card says so, with the reason.
  void aProgramThatCannotFollowIsNamedOnItsCard_data() {
    QTest::addColumn<bool>("isSetuid");
    QTest::newRow("static") << false;
    QTest::newRow("setuid") << true;
  }
  void aProgramThatCannotFollowIsNamedOnItsCard() {
    QFETCH(bool, isSetuid);
    Studio s(options(link::Cognition::Inline));
    const QString program = isSetuid ? setuidSleep(s.folder)
                                     : QCoreApplication::applicationDirPath() + "/static_sleeper";
    if (program.isEmpty()) QSKIP("only root can make a program of another user");
    auto scenario = link::loadScenario("one-robot").value();
    scenario.robots[0].runtime.profile = profileOfOne(s.folder, program, "match").toStdString();
    s.controller.open(scenario);
    QTRY_VERIFY(s.child(1, "decision").pid != 0);
    s.controller.setSpeed(8.0);
    const auto card = [&s] { return s.window.findChild<RobotCard*>(); };
    QTRY_VERIFY(card() != nullptr);
    QTRY_VERIFY2_WITH_TIMEOUT(card()->accessibleDescription().endsWith("decision uses real time"),
                              qPrintable(card()->accessibleDescription()), 30'000);
    QSet<QString> tips;
    for (int x = 0; x < card()->width(); x += 10) {
      for (int y = 0; y < card()->height(); y += 5) {
        QHelpEvent help(QEvent::ToolTip, {x, y}, card()->mapToGlobal(QPoint(x, y)));
        QCoreApplication::sendEvent(card(), &help);
        tips << QToolTip::text();
      }
    }
    QVERIFY2(tips.contains("B1 decision uses real time: the clock of the match cannot be loaded "
                           "into it (static or setuid program)"),
             qPrintable(tips.values().join('\n')));
  }
};

PITCHBOARD_GUI_TEST(TestStudioWork)

}  // namespace tst_studio_work

#include "tst_studio_work.moc"
