// SPDX-License-Identifier: GPL-3.0-or-later
// What the status line says in Live: values made by hand, no network.

#include <QtTest>
#include <cmath>

#include <ui/live/live_status.h>

namespace tst_live_status {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

link::RobotFrame robot(int number, int sender, double age) {
  link::RobotFrame made;
  made.key = {1, number, sender};
  made.identity.number = number;
  made.name = "B" + std::to_string(number);
  made.link.emplace();
  made.link->timedOut = age > 10;
  return made;
}

}  // namespace

class TestLiveStatus : public QObject {
  Q_OBJECT
 private slots:
  // Looked at five times a second, in the rhythm of the window and not of the referee.
  void twoASecondReadsTwo() {
    LiveStatus status;
    link::LiveDetails details;
    link::MatchFrame frame;
    frame.game.emplace();
    frame.reception.version = 12;
    for (int i = 0; i < 100; ++i) {
      const double seconds = i * 0.2;
      details.referee.shown = static_cast<std::uint64_t>(seconds * 2.0 + 0.3);
      details.team.datagrams = static_cast<std::uint64_t>(seconds * 6.0);
      const LiveStatusText text = status.update(details, &frame, seconds);
      if (seconds < 6.0) continue;
      const auto near = [](const QString& words, const QString& before, double wanted) {
        if (!words.startsWith(before)) return false;
        const double reported = words.mid(before.size()).section(QLatin1Char('/'), 0, 0).toDouble();
        return std::abs(reported - wanted) < 0.25;
      };
      QVERIFY2(near(text.referee, QStringLiteral("Referee: version 12, "), 2.0),
               qPrintable(text.referee));
      QVERIFY2(near(text.network, QStringLiteral("UDP "), 6.0), qPrintable(text.network));
    }
  }

  void sourcesOfTopics() {
    LiveStatus status;
    link::LiveDetails details;
    link::TopicSourceStatus& source = details.topics.emplace_back();
    source.source = link::parseFoxgloveSource("robot3").value();
    source.client.state = telemetry::FoxgloveState::Waiting;
    source.client.problem = "Cannot connect to ws://robot3:8765: Connection refused.";
    LiveStatusText text = status.update(details, nullptr, 1.0);
    QCOMPARE(text.trouble,
             QStringLiteral("Cannot connect to ws://robot3:8765: Connection refused. (retrying)"));
    source.client.state = telemetry::FoxgloveState::Connected;
    source.client.problem.clear();
    source.client.server = "bridge %4";  // a name is no place for other values
    source.channels = 15;
    source.decoded = 12;
    source.rate = 310.0;
    source.delay = 0.004;
    source.clockOffset = -2.5;
    source.unread = {"/odd: unknown"};
    text = status.update(details, nullptr, 2.0);
    QVERIFY(text.trouble.isEmpty());
    QVERIFY2(text.tip.contains(QStringLiteral("ws://robot3:8765: bridge %4, 12 of 15 topics, 310")),
             qPrintable(text.tip));
    QVERIFY(text.tip.contains(QStringLiteral("delay 4 ms above the shortest")));
    QVERIFY(text.tip.contains(QStringLiteral("loss unknown")));
    QVERIFY(text.tip.contains(QStringLiteral("not read: /odd: unknown")));
  }

  void aCounterThatBeganAnewIsNoRate() {
    RateWindow rate;
    rate.look(0.0, 1000);
    rate.look(1.0, 1010);
    QCOMPARE(rate.look(2.0, 0), 0.0);
    QCOMPARE(rate.look(3.0, 4), 4.0);
  }

  void aNumberThatAnotherProgramSendsIsNotMissed() {
    LiveStatus status;
    link::MatchFrame frame;
    frame.robots = {robot(3, 0, 60.0), robot(3, 1, 0.1)};
    QVERIFY2(status.update({}, &frame, 0.0).trouble.isEmpty(),
             qPrintable(status.update({}, &frame, 0.0).trouble));
    frame.robots.pop_back();
    QVERIFY(status.update({}, &frame, 1.0).trouble.startsWith("B3 has been offline"));
  }

  void theNewestProblemIsShown() {
    LiveStatus status;
    link::MatchFrame frame;
    frame.robots = {robot(3, 0, 60.0)};
    frame.robots[0].uid = RobotUid{3};
    QVERIFY(status.update({}, &frame, 0.0).trouble.startsWith("B3 has been offline"));
    frame.reception.conflict = true;
    const LiveStatusText later = status.update({}, &frame, 5.0);
    QCOMPARE(later.trouble, QStringLiteral("A second referee program is sending (+1 more)"));
    QVERIFY2(later.tip.contains("B3 has been offline"), qPrintable(later.tip));
    // A robot that goes offline after that is newer again.
    frame.robots.push_back(robot(4, 0, 11.0));
    frame.robots[1].uid = RobotUid{4};
    QVERIFY(status.update({}, &frame, 9.0).trouble.startsWith("B4 has been offline"));
    frame.robots.pop_back();
    QVERIFY(status.update({}, &frame, 10.0).trouble.startsWith("A second referee"));
  }
};

PITCHBOARD_GUI_TEST(TestLiveStatus)

}  // namespace tst_live_status

#include "tst_live_status.moc"
