// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of robots that are received: silence, second senders, batteries, what robots agree on, and
// the order that people give them.

#include <QDockWidget>
#include <QtTest>

#include <ui/base/notice_bar.h>
#include <ui/base/scoreboard_state.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

#include "../support/robot_keys.h"
#include "live_rig.h"
#include "live_studio.h"
#include "scoreboard.h"

namespace tst_live_cards {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using live_studio::Studio;

class TestLiveCards : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aRobotTimesOutAndComesBack() {
    Studio s;
    s.change([](link::LiveOptions& o) { o.team.timeout = std::chrono::milliseconds(300); });
    s.goLive();
    const Robot robot(s.options, 2);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QTRY_VERIFY(s.cards()[0]->state().tag.startsWith(QStringLiteral("TIMEOUT")));
    QVERIFY(s.cards()[0]->state().timedOut);
    QVERIFY(s.cards()[0]->state().action.startsWith(QStringLiteral("last: ")));
    QTRY_VERIFY(s.label("statusProcesses").contains(QStringLiteral("has been offline")));
    QVERIFY(robot.sendMessage());
    QTRY_VERIFY(!s.health().timedOut);
    QTRY_VERIFY(!s.cards()[0]->state().timedOut);
    QCOMPARE(s.health().recoveries, std::uint64_t(1));
  }

  void theSameNumberFromTwoSendersIsFlagged() {
    Studio s;
    s.goLive();
    const Robot one(s.options, 4), two(s.options, 4);
    // Two programs take turns; the order is what matters.
    const std::uint64_t before = s.live()->details().network.datagrams();
    const auto received = [&] { return s.live()->details().network.datagrams() - before; };
    for (std::uint64_t i = 0; i < 3; ++i) {
      QVERIFY(one.sendMessage());
      QTRY_COMPARE(received(), 2 * i + 1);
      telemetry::TextMessage other = live_rig::message(4);
      other.x += 100 + static_cast<int>(i);
      QVERIFY(two.sendMessage(other));
      QTRY_COMPARE(received(), 2 * i + 2);
    }
    QTRY_COMPARE(s.robots(), std::size_t(2));
    QVERIFY(s.health(0).conflict && s.health(1).conflict);
    QVERIFY(s.live()->frame()->robots[0].uid != s.live()->frame()->robots[1].uid);
    QTRY_COMPARE(s.cards().size(), qsizetype(2));
    QCOMPARE(s.cards()[0]->state().tag, QStringLiteral("two senders"));
  }

  void cardsOfOurTeamComeFirst() {
    Studio s;
    link::LiveOptions options = s.options;
    options.team.teams.resize(2);
    for (int i = 0; i < 2; ++i) {
      telemetry::TeamSetup& team = options.team.teams[static_cast<std::size_t>(i)];
      team.firstPort = team.lastPort = options.portBase + 1 + i;
    }
    s.goLive();
    s.live()->setOptions(options);
    QTRY_COMPARE(s.bound(), std::size_t(3));     // a port of each team, and the referee's
    QVERIFY(Robot(s.options, 2).sendMessage());  // a guest
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QVERIFY(Robot(s.options, 1).sendMessage());
    QTRY_COMPARE(s.cards().size(), qsizetype(2));
    QVERIFY(s.keyOn(0) == blue(1) && s.keyOn(1) == red(2));
  }

  /// Robots that come after a setup was applied stand among those that were there.
  void cardsAreSortedAfterASetup() {
    Studio s;
    s.goLive();
    for (const int number : {6, 1}) QVERIFY(Robot(s.options, number).sendMessage());
    QTRY_COMPARE(s.cards().size(), qsizetype(2));
    link::LiveOptions options = s.options;
    options.team.teams.resize(1);
    s.live()->setOptions(options);
    const Robot one(s.options, 1), two(s.options, 2), six(s.options, 6);
    const auto sorted = [&] {
      if (!six.sendMessage() || !two.sendMessage() || !one.sendMessage()) return false;
      const QList<RobotCard*> cards = s.cards();
      return cards.size() == 3 && s.keyOn(0) == blue(1) && s.keyOn(1) == blue(2) &&
             s.keyOn(2) == blue(6);
    };
    QTRY_VERIFY(sorted());
    // Their team is the other one's opponent now.
    options.team.teams.emplace_back().firstPort = options.portBase + 1;
    options.team.teams.back().lastPort = options.portBase + 1;
    std::swap(options.team.teams[0], options.team.teams[1]);
    s.live()->setOptions(options);
    const auto ids = [&] {
      QStringList all;
      for (int i = 0; i < s.cards().size(); ++i) {
        all << QStringLiteral("%1/%2").arg(s.keyOn(i).team).arg(s.keyOn(i).number);
      }
      return all.join(QLatin1Char(' '));
    };
    QTRY_VERIFY(one.sendMessage() && ids() == QStringLiteral("1/1 2/1 2/2 2/6"));
  }

  void lowBatteryAndUnresponsiveProcess() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 1);
    telemetry::TextMessage m = live_rig::message(1);
    m.voltage = 135;
    QVERIFY(robot.sendMessage(m));
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QTRY_COMPARE(s.cards()[0]->state().tag, QStringLiteral("battery low"));
    for (int i = 0; i < 8; ++i) {
      m.decision = 0;
      m.x += 1;
      QVERIFY(robot.sendMessage(m));
    }
    QTRY_VERIFY(s.cards()[0]->state().tag.startsWith(QStringLiteral("D no reply")));
  }

  void robotsAgreeOnTheBall() {
    Studio s;
    s.goLive();
    const auto hasText = [&](int number, int x, double distance) {
      telemetry::TextMessage m = live_rig::message(number);
      m.x = x;
      m.y = 300;
      m.theta = 0;
      m.ballAngle = 0;
      m.ballDist = static_cast<float>(distance);
      return Robot(s.options, number).sendMessage(m);
    };
    QVERIFY(hasText(1, 300, 150) && hasText(2, 200, 270) && hasText(3, 100, 20));
    QTRY_COMPARE(s.robots(), std::size_t(3));
    QTRY_COMPARE(s.live()->frame()->teamBalls.size(), std::size_t(1));
    const link::TeamBall ball = s.live()->frame()->teamBalls.front();
    QCOMPARE(ball.agree, 2);
    QCOMPARE(ball.see, 3);
    QVERIFY(qAbs(ball.position.x - 0.10) < 1e-6);
    QVERIFY(qAbs(ball.spread - 0.10) < 1e-6);
  }

  void cardsFloatReorderAndHide() {
    Studio s;
    s.goLive();
    for (int n = 1; n <= 3; ++n) QVERIFY(Robot(s.options, n).sendMessage());
    QTRY_COMPARE(s.cards().size(), qsizetype(3));
    auto* dock = s.window.findChild<RobotsDock*>();
    // Drag the first below the last.
    RobotCard* first = s.cards()[0];
    const QPoint below =
        first->mapFromGlobal(s.cards()[2]->mapToGlobal(QPoint(60, s.cards()[2]->height() - 2)));
    QTest::mousePress(first, Qt::LeftButton, {}, QPoint(60, 40));
    QTest::mouseMove(first, QPoint(60, 60));
    QTest::mouseMove(first, below);
    QTest::mouseRelease(first, Qt::LeftButton, {}, below);
    QCOMPARE(s.cards()[2], first);
    const RobotUid uid = first->state().id;
    dock->floatCard(uid);
    QCOMPARE(s.cards().size(), qsizetype(2));
    QVERIFY(dock->floating(uid)->isFloating());
    QVERIFY(first->isVisible());
    dock->floating(uid)->close();
    QCOMPARE(s.cards().size(), qsizetype(3));
    QVERIFY(first->isVisible());
    CardParts parts = dock->parts();
    const int tall = first->sizeHint().height();
    parts.processes = parts.battery = false;
    dock->setParts(parts);
    QVERIFY(first->sizeHint().height() < tall);
    parts.values << QStringLiteral("BALL_DIST") << QStringLiteral("X");
    dock->setParts(parts);
    QVERIFY(!first->grab().isNull());
    QCOMPARE(s.settings.value(QStringLiteral("cards/values")).toStringList().size(), qsizetype(2));
    QVERIFY(s.settings.value(QStringLiteral("cards/hidden"))
                .toStringList()
                .contains(QStringLiteral("battery")));
  }
};

PITCHBOARD_GUI_TEST(TestLiveCards)

}  // namespace tst_live_cards

#include "tst_live_cards.moc"
