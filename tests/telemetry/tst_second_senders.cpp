// SPDX-License-Identifier: GPL-3.0-or-later
// Who is who: two programs with one number, new addresses, new ports, late messages.

#include <QtTest>

#include <base/actions.h>
#include <telemetry/wire/team_monitor.h>

#include "monitor_rig.h"

namespace tst_second_senders {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;
using Verdict = TeamMonitor::Verdict;
using namespace monitor_rig;

class TestSecondSenders : public QObject {
  Q_OBJECT
 private slots:
  void oneNumberFromTwoSendersIsFlagged() {
    TeamMonitor monitor;
    give(monitor, text(1), start, from(1));
    QVERIFY(!monitor.status(start).robots[0].conflict);
    give(monitor, text(1), start, from(2));
    give(monitor, text(2), start, from(2));
    TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(3));
    QVERIFY(team.robots[0].conflict && team.robots[1].conflict && !team.robots[2].conflict);
    give(monitor, text(1), start + 10s, from(2));
    team = monitor.status(start + 10s);
    QVERIFY(!team.robots[0].conflict && !team.robots[1].conflict);
  }

  void twoProgramsOnOneComputerAreTwoRobots() {
    TeamMonitor monitor;
    for (int i = 0; i < 3; ++i) {
      give(monitor, text(1, 1, 120), start + i * 1s, from(1, 5000));
      give(monitor, text(1, 1, 121), start + i * 1s + 500ms, from(1, 6000));
    }
    const TeamStatus team = monitor.status(start + 3s);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QVERIFY(team.robots[0].conflict && team.robots[1].conflict);
  }

  void aNewPortEachTimeIsOneRobot() {
    TeamMonitor monitor;
    for (int i = 0; i < 100; ++i) give(monitor, text(1), start + i * 1s, from(1, 5000 + i));
    const TeamStatus team = monitor.status(start + 99s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QVERIFY(!team.robots[0].conflict);
    QCOMPARE(team.robots[0].messages, std::uint64_t(100));
  }

  void anotherAddressIsTheSameRobot() {
    TeamMonitor monitor;
    for (int i = 0; i < 5; ++i) give(monitor, text(3), start + i * 1s, from(1));
    for (int i = 5; i < 9; ++i) {
      QCOMPARE(give(monitor, text(3), start + i * 1s, from(7)), Verdict::Used);
      QCOMPARE(monitor.usedSlot(), 0);
    }
    const TeamStatus team = monitor.status(start + 9s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QCOMPARE(team.robots[0].sender.address, from(7).address);
    QCOMPARE(team.robots[0].messages, std::uint64_t(9));
    QVERIFY(!team.robots[0].conflict);
  }

  void whoSpeaksAgainIsAnotherProgram_data() {
    QTest::addColumn<int>("phase");
    QTest::newRow("soon after it") << 200;
    QTest::newRow("half way") << 500;
    QTest::newRow("nearly at its turn") << 900;
  }
  void whoSpeaksAgainIsAnotherProgram() {
    QFETCH(int, phase);
    TeamMonitor monitor;
    for (int i = 0; i < 8; ++i) {
      give(monitor, text(3, 1, 120), start + i * 1s, from(1));
      if (i > 0) QCOMPARE(monitor.usedSlot(), 0);  // the first one stays what it is
      if (i < 3) continue;
      give(monitor, text(3, 1, 100), start + i * 1s + phase * 1ms, from(2));
      if (i > 3) QCOMPARE(monitor.usedSlot(), 1);
    }
    TeamStatus team = monitor.status(start + 8s);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QCOMPARE(team.robots[0].sender, from(1));
    QCOMPARE(team.robots[0].value(FieldMeaning::Voltage), std::optional(120.0));
    QCOMPARE(team.robots[1].sender, from(2));
    QCOMPARE(team.robots[1].value(FieldMeaning::Voltage), std::optional(100.0));
    QVERIFY(team.robots[0].conflict && team.robots[1].conflict);
    // Until one is silent.
    for (int i = 8; i < 20; ++i) give(monitor, text(3, 1, 100), start + i * 1s, from(2));
    team = monitor.status(start + 20s);
    QVERIFY(team.robots[0].timedOut && !team.robots[0].conflict && !team.robots[1].conflict);
    // Forgotten by hand: the other one is the robot of that number.
    monitor.forget(3, 0);
    QCOMPARE(give(monitor, text(3, 1, 100), start + 20s, from(2)), Verdict::Used);
    QCOMPARE(monitor.usedSlot(), 0);
    QCOMPARE(monitor.status(start + 20s).robots.size(), std::size_t(1));
  }

  void theSecondOneCanBeForgotten() {
    TeamMonitor monitor;
    give(monitor, text(3), start, from(1));
    give(monitor, text(3), start + 100ms, from(2));
    give(monitor, text(3), start + 200ms, from(9));
    QCOMPARE(monitor.status(start).robots.size(), std::size_t(3));
    monitor.forget(3, 1);
    TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QCOMPARE(team.robots[1].slot, 2);
    // Its slot is free again.
    give(monitor, text(3), start + 300ms, from(4));
    QCOMPARE(monitor.usedSlot(), 1);
  }

  void madeUpRobotsDoNotKeepRealOnesOut() {
    TeamMonitor monitor;
    for (int i = 1000; i < 3000; ++i) give(monitor, text(i), start, from(9));
    for (int i = 1; i <= 32; ++i) QCOMPARE(give(monitor, text(i), start), Verdict::Used);
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), MonitorOptions::mostRobots(0));
    QCOMPARE(team.refusedRobots, std::uint64_t(2000 - 32));
  }

  void eachTeamHasPlacesOfItsOwn() {
    MonitorOptions options;
    for (const int port : {12001, 12002, 12003}) {
      TeamSetup& team = options.teams.emplace_back();
      team.firstPort = team.lastPort = port;
    }
    TeamMonitor monitor({}, options);
    const auto say = [&](int port, int robot, WallTime time) {
      const std::string message = text(robot);
      return monitor.take({time, from(1), static_cast<std::uint16_t>(port), false, message});
    };
    // Somebody makes up numbers in one team.
    for (int i = 100; i < 300; ++i) say(12001, i, start);
    for (const int port : {12001, 12002, 12003}) {
      for (int i = 1; i <= 32; ++i) QCOMPARE(say(port, i, start), Verdict::Used);
    }
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(3 * 32 + 32));
    QCOMPARE(team.robots.size(), options.mostRobots());
    QCOMPARE(team.refusedRobots, std::uint64_t(200 - 32));
    // Two teams are left: the third one's robots are gone, the others stay.
    options.teams.pop_back();
    monitor.setOptions(options);
    QCOMPARE(monitor.status(start).robots.size(), std::size_t(2 * 32 + 32));
    options.teams.clear();
    monitor.setOptions(options);
    for (const RobotStatus& robot : monitor.status(start).robots) QVERIFY(robot.number < teamStep);
  }
};

PITCHBOARD_TEST(TestSecondSenders)

}  // namespace tst_second_senders

#include "tst_second_senders.moc"
