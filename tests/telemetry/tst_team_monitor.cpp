// SPDX-License-Identifier: GPL-3.0-or-later

#include <QtTest>

#include <cmath>

#include <telemetry/monitor/team_monitor.h>

#include "monitor_rig.h"

namespace tst_team_monitor {

using namespace pitchboard::telemetry;
using namespace std::chrono_literals;
using Verdict = TeamMonitor::Verdict;
using namespace monitor_rig;

class TestTeamMonitor : public QObject {
  Q_OBJECT
 private slots:
  void aRobotAppearsTimesOutAndComesBack() {
    TeamMonitor monitor;
    QCOMPARE(give(monitor, text(3), start), Verdict::Used);
    TeamStatus team = monitor.status(start + 1s);
    QCOMPARE(team.robots.size(), std::size_t(1));
    QCOMPARE(team.robots[0].key.number, 3);
    QCOMPARE(team.robots[0].age, Duration(1s));
    QCOMPARE(team.robots[0].value(FieldMeaning::X), std::optional(450.0));
    QVERIFY(!monitor.status(start + 9999ms).robots[0].timedOut);
    const RobotStatus gone = monitor.status(start + 10s).robots[0];
    QVERIFY(gone.timedOut);
    QVERIFY(gone.processes[0].state == HeartbeatState::Unknown);
    QCOMPARE(give(monitor, text(3), start + 20s), Verdict::Used);
    const RobotStatus back = monitor.status(start + 20s).robots[0];
    QVERIFY(!back.timedOut);
    QCOMPARE(back.recoveries, std::uint64_t(1));
    QCOMPARE(back.offline, Duration(20s));
    QCOMPARE(back.messages, std::uint64_t(2));
    QVERIFY(back.processes[0].state == HeartbeatState::Working);
  }

  void processesAreFilteredAsPublished() {
    ProcessFilter filter;
    QCOMPARE(filter.probability(), 0.5);
    double p = 0.5;
    for (const bool flag : {true, true, false, false, false, true, false, false, false, false}) {
      p = flag ? 0.9 * p / (0.01 + 0.89 * p) : 0.1 * p / (0.99 - 0.89 * p);
      p = std::min(0.999, std::max(0.001, p));
      filter.update(flag);
      QCOMPARE(filter.probability(), p);
      QCOMPARE(filter.working(), p >= 0.5);
    }
    for (int i = 0; i < 100; ++i) filter.update(false);
    QCOMPARE(filter.probability(), 0.001);
    for (int i = 0; i < 100; ++i) filter.update(true);
    QCOMPARE(filter.probability(), 0.999);
  }

  void badMessagesAreCountedNotTheirMistakes() {
    TeamMonitor monitor;
    give(monitor, text(3), start);
    // nan, a fraction, a flag of 7, text behind the end.
    const std::string bad = "3 nan 300 90 9.5 80 10 7 1 1 1 1 8.5 0.5 124 OUT more";
    for (int i = 1; i <= 3; ++i) give(monitor, bad, start + std::chrono::seconds(i));
    const TeamStatus team = monitor.status(start + 4s);
    QCOMPARE(team.errors.count(TextError::BadFlag), std::uint64_t{3});
    QCOMPARE(team.errors.count(TextError::TrailingText), std::uint64_t{3});
    QCOMPARE(team.errors.messages(), std::uint64_t{3});
    QCOMPARE(team.robots[0].errorCount, std::uint64_t{3});
    TeamMonitor restored;
    QVERIFY(restored.restoreRobots(monitor.robotsText(start), start));
    QCOMPARE(restored.status(start + 4s).robots[0].errorCount, std::uint64_t{3});
  }

  void aProcessThatStopsRespondingIsKnownSince() {
    TeamMonitor monitor;
    for (int i = 0; i < 5; ++i) give(monitor, text(1, 1), start + i * 1s);
    WallTime silentAt{};
    for (int i = 5; i < 15; ++i) {
      give(monitor, text(1, 0), start + i * 1s);
      const ProcessHeartbeat decision = monitor.status(start + i * 1s).robots[0].processes[3];
      if (decision.state == HeartbeatState::NotResponding && silentAt == WallTime{})
        silentAt = start + i * 1s;
    }
    QVERIFY(silentAt != WallTime{});
    const RobotStatus robot = monitor.status(start + 15s).robots[0];
    QVERIFY(robot.processes[3].state == HeartbeatState::NotResponding);
    QCOMPARE(robot.processes[3].since, start + 15s - silentAt);
  }

  void rateAndJitter() {
    TeamMonitor monitor;
    for (int i = 0; i < 40; ++i) give(monitor, text(1), start + i * 100ms);
    RobotStatus robot = monitor.status(start + 3900ms).robots[0];
    QVERIFY(std::abs(robot.rate - 10.0) < 1e-6);
    QVERIFY(robot.jitter < 1e-9);
    // While nothing comes the rate falls.
    QVERIFY(monitor.status(start + 8s).robots[0].rate < 6.0);
    for (int i = 0; i < 40; ++i) give(monitor, text(2), start + i * 100ms + (i % 2) * 20ms);
    robot = monitor.status(start + 3900ms).robots[1];
    QVERIFY(std::abs(robot.jitter - 0.02) < 0.001);
  }

  void lossNeedsASequenceNumber() {
    TeamMonitor plain;
    give(plain, text(1), start);
    QVERIFY(!plain.status(start).robots[0].loss);
    Profile profile = publishedProfile();
    profile.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    TeamMonitor monitor(profile);
    const int numbers[] = {1, 2, 5, 6, 4, 6, 7};
    int i = 0;
    for (const int number : numbers) {
      const auto verdict =
          give(monitor, text(1, 1, 124, " " + std::to_string(number)), start + i++ * 1s);
      QCOMPARE(verdict == Verdict::Duplicate, i == 6);
    }
    const RobotStatus robot = monitor.status(start + 7s).robots[0];
    QCOMPARE(robot.lost, std::uint64_t(1));  // 3; the late 4 did arrive
    QCOMPARE(robot.messages, std::uint64_t(6));
    QCOMPARE(robot.errors.count(TextError::Duplicate), std::uint64_t(1));
    QVERIFY(std::abs(*robot.loss - 1.0 / 7.0) < 1e-9);
    // A robot that starts again, with another socket, counts nothing as lost.
    give(monitor, text(1, 1, 124, " 5000"), start + 8s, from(1, 5001));
    QCOMPARE(monitor.status(start + 8s).robots[0].lost, std::uint64_t(1));
  }

  void theSameMessageTwiceAtOnce() {
    TeamMonitor monitor;
    QCOMPARE(give(monitor, text(1), start), Verdict::Used);
    QCOMPARE(give(monitor, text(1), start + 1ms), Verdict::Duplicate);
    // A robot that stands still says the same a second later.
    QCOMPARE(give(monitor, text(1), start + 1s), Verdict::Used);
    const TeamStatus team = monitor.status(start + 1s);
    QCOMPARE(team.errors.count(TextError::Duplicate), std::uint64_t(1));
    QCOMPARE(team.robots[0].messages, std::uint64_t(2));
  }

  void aLateMessageChangesNothing() {
    Profile profile = publishedProfile();
    profile.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    TeamMonitor monitor(profile);
    give(monitor, text(1, 1, 120, " 7"), start);
    give(monitor, text(1, 1, 119, " 9"), start + 1s);
    QCOMPARE(give(monitor, text(1, 0, 180, " 8"), start + 1010ms), Verdict::Late);
    const RobotStatus robot = monitor.status(start + 2s).robots[0];
    QCOMPARE(robot.value(FieldMeaning::Voltage), std::optional(119.0));
    QCOMPARE(robot.battery->volts, 11.9);
    QCOMPARE(robot.late, std::uint64_t(1));
    QCOMPARE(robot.lost, std::uint64_t(0));
    QCOMPARE(robot.messages, std::uint64_t(3));
    QCOMPARE(robot.age, Duration(990ms));  // it is a sign of life
  }

  void aCounterOfThirtyTwoBitsIsRead() {
    Profile profile = publishedProfile();
    profile.fields.push_back({"SEQ", FieldType::Int, "", "Network", FieldMeaning::Sequence});
    profile.fields.back().bits = 32;
    TeamMonitor monitor(profile);
    QCOMPARE(give(monitor, text(1, 1, 120, " 4294967294"), start), Verdict::Used);
    QCOMPARE(give(monitor, text(1, 1, 120, " 1"), start + 1s), Verdict::Used);
    QCOMPARE(monitor.status(start + 1s).robots[0].lost, std::uint64_t(2));
  }

  /// A battery of which only the share is sent, as % or from 0 to 1.
  void aChargeIsABattery() {
    for (const auto& [unit, sent] : {std::pair("%", "25"), std::pair("1", "0.25")}) {
      Profile profile = publishedProfile();
      profile.end.clear();
      profile.fields = {{"n", FieldType::Int, "", "", FieldMeaning::Robot},
                        {"B", FieldType::Float, unit, "", FieldMeaning::Charge}};
      QVERIFY(validate(profile));
      MonitorOptions options;
      options.battery = defaultBattery;
      TeamMonitor monitor(profile, options);
      QCOMPARE(give(monitor, std::string("3 ") + sent, start), Verdict::Used);
      const RobotStatus robot = monitor.status(start).robots.at(0);
      QCOMPARE(robot.value(FieldMeaning::Charge), std::optional(25.0));
      QCOMPARE(robot.battery->fraction, 0.25);
      QCOMPARE(robot.battery->volts, 0.0);
      QVERIFY(robot.battery->low);  // as low as 16 V of five cells: 30 %
      const std::string state = monitor.robotsText(start);
      TeamMonitor again(profile, options);
      QVERIFY(again.restoreRobots(state, start));
      QVERIFY(again.status(start).robots.at(0).battery == robot.battery);
      QCOMPARE(give(monitor, unit == std::string("%") ? "3 35" : "3 0.35", start + 1s),
               Verdict::Used);
      QVERIFY(!monitor.status(start + 1s).robots.at(0).battery->low);
    }
  }

  void atMostSixtyFour() {
    TeamMonitor monitor;
    for (int i = 1; i <= 100; ++i) {
      QCOMPARE(give(monitor, text(i), start), i <= 64 ? Verdict::Used : Verdict::TooManyRobots);
    }
    TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(64));
    QCOMPARE(team.refusedRobots, std::uint64_t(36));
    // A robot that has timed out makes room.
    QCOMPARE(give(monitor, text(200), start + 10s), Verdict::Used);
    QCOMPARE(monitor.status(start + 10s).robots.size(), std::size_t(64));
    for (unsigned host = 0; host < 1000; ++host) give(monitor, "junk", start + 11s, from(host));
    team = monitor.status(start + 11s);
    QCOMPARE(team.senders.size(), std::size_t(64));
    QCOMPARE(team.errors.count(TextError::MissingFields), std::uint64_t(1000));
  }

  void errorsBelongToRobotAndSender() {
    TeamMonitor monitor;
    give(monitor, text(1), start, from(1));
    QCOMPARE(give(monitor, "1 2 3", start, from(1)), Verdict::Refused);
    QCOMPARE(give(monitor, "\x01", start, from(2)), Verdict::Refused);
    QCOMPARE(give(monitor, text(9).substr(0, 12), start, from(2)), Verdict::Refused);
    const std::string whole = text(1);
    QCOMPARE(monitor.take({start, from(1), 1241, true, whole}), Verdict::Refused);
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(1));  // a bad message makes no robot
    QCOMPARE(team.robots[0].errors.count(TextError::MissingEnd), std::uint64_t(1));
    QCOMPARE(team.robots[0].errors.sample(TextError::MissingEnd), std::string("1 2 3"));
    QCOMPARE(team.robots[0].errors.count(TextError::Truncated), std::uint64_t(1));
    QCOMPARE(team.senders[1].errors.count(TextError::Binary), std::uint64_t(1));
    QCOMPARE(team.senders[1].errors.count(TextError::MissingFields), std::uint64_t(1));
    QCOMPARE(team.senders[1].datagrams, std::uint64_t(2));
  }

  void onlyListedSenders() {
    MonitorOptions options;
    QVERIFY(options.senders.add("10.0.0.0/30"));
    QVERIFY(options.senders.add("192.168.7.9"));
    for (const char* bad :
         {"", "10.0.0", "10.0.0.0/33", "10.0.0.0/", "host", "1.2.3.4.5", "10.0.0.0/-1"}) {
      QVERIFY2(!options.senders.add(bad), bad);
    }
    TeamMonitor monitor(publishedProfile(), options);
    QCOMPARE(give(monitor, text(1), start, from(3)), Verdict::Used);
    QCOMPARE(give(monitor, text(2), start, from(4)), Verdict::SenderRefused);
    QCOMPARE(give(monitor, text(2), start, {{0xc0a80709}, 1}), Verdict::Used);
    QCOMPARE(monitor.status(start).refusedByFilter, std::uint64_t(1));
  }

  void battery_data() {
    QTest::addColumn<int>("tenths");
    QTest::addColumn<int>("cells");
    QTest::addColumn<int>("expectedCells");
    QTest::addColumn<bool>("low");
    QTest::newRow("three cells") << 124 << 0 << 3 << false;
    QTest::newRow("published 18.9 V") << 189 << 0 << 5 << false;
    QTest::newRow("low") << 104 << 3 << 3 << true;
    QTest::newRow("at the limit") << 105 << 3 << 3 << false;
    QTest::newRow("nothing") << 0 << 0 << 1 << true;
    QTest::newRow("absurd") << 2'000'000'000 << 0 << 234 << false;
    QTest::newRow("negative") << -5 << 0 << 1 << true;
  }
  void battery() {
    QFETCH(int, tenths);
    QFETCH(int, cells);
    QFETCH(int, expectedCells);
    QFETCH(bool, low);
    MonitorOptions options;
    options.battery.cells = cells;
    TeamMonitor monitor(publishedProfile(), options);
    give(monitor, text(1, 1, tenths), start);
    const Battery battery = *monitor.status(start).robots[0].battery;
    QCOMPARE(battery.volts, tenths / 10.0);
    QCOMPARE(battery.cells, expectedCells);
    QCOMPARE(battery.low, low);
    QVERIFY(battery.fraction >= 0.0 && battery.fraction <= 1.0);
  }

  void aClockSetBackIsNoDisaster() {
    TeamMonitor monitor;
    give(monitor, text(1), start);
    give(monitor, text(1), start - 1h);
    QCOMPARE(monitor.status(start - 2h).robots[0].age, Duration(0));
    QVERIFY(!monitor.status(start - 2h).robots[0].timedOut);
    QVERIFY(std::isfinite(monitor.status(start).robots[0].rate));
  }

  void aNewProfileGivesNames() {
    TeamMonitor monitor;
    give(monitor, text(1, 1, 124, " 77"), start);
    QCOMPARE(monitor.status(start).robots[0].name(15), std::string("OTHER_1"));
    Profile profile = publishedProfile();
    profile.fields.push_back({"TEMPERATURE", FieldType::Int, "°C", "Robot", FieldMeaning::None});
    monitor.setProfile(profile);
    // What was said before is still shown as it was read.
    QCOMPARE(monitor.status(start).robots[0].name(15), std::string("OTHER_1"));
    give(monitor, text(1, 1, 124, " 77"), start + 1s);
    const RobotStatus robot = monitor.status(start + 1s).robots[0];
    QCOMPARE(robot.name(15), std::string("TEMPERATURE"));
    QCOMPARE(robot.values[15], 77.0);
    QCOMPARE(robot.messages, std::uint64_t(2));
  }
};

PITCHBOARD_TEST(TestTeamMonitor)

}  // namespace tst_team_monitor

#include "tst_team_monitor.moc"
