// SPDX-License-Identifier: GPL-3.0-or-later
// Which robot sends: two programs with one number, new addresses, new ports, late messages.

#include <QtTest>

#include <telemetry/monitor/team_monitor.h>

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
    give(monitor, text(1, 1, 120), start, from(1));
    QVERIFY(!monitor.status(start).robots[0].conflict);
    give(monitor, text(1, 1, 121), start, from(2));
    give(monitor, text(2), start, from(2));
    TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(3));
    QVERIFY(team.robots[0].conflict && team.robots[1].conflict && !team.robots[2].conflict);
    give(monitor, text(1, 1, 121), start + 10s, from(2));
    team = monitor.status(start + 10s);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QVERIFY(!team.robots[0].conflict && !team.robots[1].conflict);
  }

  /// Such as a robot with two network cards.
  void sendersOfEqualMessagesAreOneRobot() {
    TeamMonitor monitor;
    for (int i = 0; i < 5; ++i) {
      give(monitor, text(3, 1, 120 + i), start + i * 1s, from(1));
      QCOMPARE(give(monitor, text(3, 1, 120 + i), start + i * 1s + 10ms, from(2)),
               Verdict::Duplicate);
    }
    TeamStatus team = monitor.status(start + 4s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QCOMPARE(team.robots[0].sender, from(1));
    QCOMPARE(team.robots[0].others, std::vector<Sender>{from(2)});
    QVERIFY(team.robots[0].conflict);
    QCOMPARE(team.robots[0].messages, std::uint64_t(5));
    TeamMonitor again;
    QVERIFY(again.restoreRobots(monitor.robotsText(start), start));
    QCOMPARE(again.status(start + 4s).robots.at(0).others, std::vector<Sender>{from(2)});
    // Until it says something else.
    QCOMPARE(give(monitor, text(3, 1, 90), start + 4s + 20ms, from(2)), Verdict::Used);
    QCOMPARE(monitor.used(), (pitchboard::RobotKey{0, 3, 1}));
    team = monitor.status(start + 5s);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QVERIFY(team.robots[0].others.empty());
    // And it leaves when it falls silent.
    for (int i = 5; i < 15; ++i) give(monitor, text(3), start + i * 1s, from(1));
    team = monitor.status(start + 15s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QVERIFY(!team.robots[0].conflict);
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
      QCOMPARE(monitor.used().sender, 0);
    }
    const TeamStatus team = monitor.status(start + 9s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QCOMPARE(team.robots[0].sender.address, from(7).address);
    QCOMPARE(team.robots[0].messages, std::uint64_t(9));
    QVERIFY(!team.robots[0].conflict);
  }

  void aReturningSenderIsAnotherProgram_data() {
    QTest::addColumn<int>("phase");
    QTest::newRow("soon after it") << 200;
    QTest::newRow("half way") << 500;
    QTest::newRow("nearly at its turn") << 900;
  }
  void aReturningSenderIsAnotherProgram() {
    QFETCH(int, phase);
    TeamMonitor monitor;
    for (int i = 0; i < 8; ++i) {
      give(monitor, text(3, 1, 120), start + i * 1s, from(1));
      if (i > 0) QCOMPARE(monitor.used().sender, 0);  // the first one stays what it is
      if (i < 3) continue;
      give(monitor, text(3, 1, 100), start + i * 1s + phase * 1ms, from(2));
      if (i > 3) QCOMPARE(monitor.used().sender, 1);
    }
    TeamStatus team = monitor.status(start + 8s);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QCOMPARE(team.robots[0].sender, from(1));
    QCOMPARE(team.robots[0].value(FieldMeaning::Voltage), std::optional(120.0));
    QCOMPARE(team.robots[1].sender, from(2));
    QCOMPARE(team.robots[1].value(FieldMeaning::Voltage), std::optional(100.0));
    QVERIFY(team.robots[0].conflict && team.robots[1].conflict);
    // Until one is silent: the other one is the robot of that number, and nobody is missed.
    for (int i = 8; i < 20; ++i) {
      const WallTime now = start + i * 1s + phase * 1ms;
      give(monitor, text(3, 1, 100), now, from(2));
      for (const RobotStatus& robot : monitor.status(now).robots) QVERIFY(!robot.timedOut);
    }
    team = monitor.status(start + 20s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QCOMPARE(team.robots[0].key, (pitchboard::RobotKey{0, 3, 0}));
    QCOMPARE(team.robots[0].sender, from(2));
    QVERIFY(!team.robots[0].conflict);
  }

  void whoIsForgottenGivesItsPlaceToTheSecondOne() {
    TeamMonitor monitor;
    give(monitor, text(3, 1, 120), start, from(1));
    give(monitor, text(3, 1, 100), start + 100ms, from(2));
    QCOMPARE(monitor.used().sender, 1);
    monitor.forget({0, 3, 0});
    QCOMPARE(give(monitor, text(3, 1, 100), start + 1s, from(2)), Verdict::Used);
    QCOMPARE(monitor.used().sender, 0);
    QCOMPARE(monitor.status(start + 1s).robots.size(), std::size_t(1));
  }

  void theSecondOneCanBeForgotten() {
    TeamMonitor monitor;
    give(monitor, text(3, 1, 120), start, from(1));
    give(monitor, text(3, 1, 121), start + 100ms, from(2));
    give(monitor, text(3, 1, 122), start + 200ms, from(9));
    QCOMPARE(monitor.status(start).robots.size(), std::size_t(3));
    monitor.forget({0, 3, 1});
    TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QCOMPARE(team.robots[1].key.sender, 2);
    // Its key is free again.
    give(monitor, text(3, 1, 123), start + 300ms, from(4));
    QCOMPARE(monitor.used().sender, 1);
  }

  void madeUpRobotsDoNotKeepRealOnesOut() {
    TeamMonitor monitor;
    for (int i = 1000; i < 3000; ++i) give(monitor, text(i), start, from(9));
    for (int i = 1; i <= 32; ++i) QCOMPARE(give(monitor, text(i), start), Verdict::Used);
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), MonitorOptions::maxRobots(0));
    QCOMPARE(team.refusedRobots, std::uint64_t(2000 - 32));
  }

  void eachTeamHasPlacesOfItsOwn() {
    MonitorOptions options;
    for (const int port : {12001, 12002, 12003}) {
      TeamSetup& team = options.teams.emplace_back();
      team.firstPort = team.lastPort = port;
    }
    TeamMonitor monitor({}, options);
    const auto send = [&](int port, int robot, WallTime time) {
      const std::string message = text(robot);
      return monitor.take({time, from(1), static_cast<std::uint16_t>(port), false, message});
    };
    // Somebody makes up numbers in one team.
    for (int i = 100; i < 300; ++i) send(12001, i, start);
    for (const int port : {12001, 12002, 12003}) {
      for (int i = 1; i <= 32; ++i) QCOMPARE(send(port, i, start), Verdict::Used);
    }
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(3 * 32 + 32));
    QCOMPARE(team.robots.size(), options.maxRobots());
    QCOMPARE(team.refusedRobots, std::uint64_t(200 - 32));
    // Two teams are left: the third one's robots have no team, and go when they fall silent.
    options.teams.pop_back();
    monitor.setOptions(options);
    QCOMPARE(monitor.status(start).robots.size(), std::size_t(3 * 32 + 32));
    QCOMPARE(monitor.status(start + 10s).robots.size(), std::size_t(2 * 32 + 32));
    options.teams.clear();
    monitor.setOptions(options);
    for (const RobotStatus& robot : monitor.status(start).robots) QCOMPARE(robot.key.team, 0);
  }
};

PITCHBOARD_TEST(TestSecondSenders)

}  // namespace tst_second_senders

#include "tst_second_senders.moc"
