// SPDX-License-Identifier: GPL-3.0-or-later
// What the automatic referee decides: goals and balls that leave the field, drop balls, double
// touches, and which robots it removes.
#include "../support/referee_game.h"

namespace tst_referee_judge {

using namespace pitchboard;
using sim::CallKind;

class TestRefereeJudge : public QObject {
  Q_OBJECT

 private slots:
  void aGoalCountsAtEveryRate_data() {
    QTest::addColumn<double>("rate");
    QTest::addColumn<double>("speed");
    for (const double rate : {10.0, 30.0, 60.0, 500.0}) {
      for (const double speed : {2.0, 8.0, 25.0}) {
        QTest::addRow("%g Hz, %g m/s", rate, speed) << rate << speed;
      }
    }
  }
  void aGoalCountsAtEveryRate() {
    QFETCH(double, rate);
    QFETCH(double, speed);
    RefereeGame game("humanoid-2021", true, rate);
    game.simulation->editState().game->breakLeft = 0;
    game.runTo(80);  // READY, SET, PLAYING, and the ball is everybody's
    QCOMPARE(game.game().state, PlayState::Playing);
    QVERIFY(game.simulation->placeBall({4.1, 0.6}, {speed, 0.0}));
    game.runTo(81);
    QCOMPARE(game.game().teams[0].score, 1);
    QCOMPARE(game.game().state, PlayState::Ready);
    QCOMPARE(game.game().kickOff, 1);
    QVERIFY(std::hypot(game.simulation->snapshot().ball.x, game.simulation->snapshot().ball.y) <
            1e-9);
  }

  void aBallPutBehindTheNetIsNoGoal() {
    RefereeGame game("humanoid-2021", true);
    game.runTo(80);
    QVERIFY(game.simulation->placeBall({5.3, 0.0}));
    game.runTo(81);
    QCOMPARE(game.game().teams[0].score + game.game().teams[1].score, 0);
    QVERIFY(game.happened(sim::EventKind::BallOut));
  }

  void theBallGoesToWhoDidNotTouchItLast() {
    RefereeGame game("humanoid-2021", true);
    game.runTo(80);
    // Blue 2 stands at (-2.5, 2): the ball rolls past it over the touch line.
    game.touch({-2.5, 2.0 + game.atTheBall()}, {0.0, 3.0});
    game.runTo(82);
    QCOMPARE(game.game().setPlay(), SetPlay::ThrowIn);
    QCOMPARE(game.game().setPlayTeam(), 1);
    game.runTo(90);
    const Point ball = game.simulation->snapshot().ball;
    QVERIFY2(std::abs(ball.y - 3.0) < 1e-6, qPrintable(QString::number(ball.y)));
  }

  void overTheGoalLineItIsACornerOrAGoalKick() {
    for (const bool byDefender : {true, false}) {
      RefereeGame game("humanoid-soccer-2026", true);
      game.runTo(80);
      const int robot = byDefender ? 4 : 2;  // red 1 or blue 2, before the right goal line
      QVERIFY(game.simulation->placeRobot(RobotId{robot}, {{4.0, 2.5}, 0.0}));
      game.touch({4.0 + game.atTheBall(), 2.5}, {3.0, 0.0});
      game.runTo(82);
      QCOMPARE(game.game().setPlay(), byDefender ? SetPlay::CornerKick : SetPlay::GoalKick);
      QCOMPARE(game.game().setPlayTeam(), byDefender ? 0 : 1);
      QVERIFY(game.game().stopped);
    }
  }

  void rulesCanBeSwitchedOff() {
    RefereeGame game("humanoid-2021", true);
    sim::RefereeRules rules = *game.simulation->state().settings.referee;
    rules.throwIns = false;
    rules.dropBalls = false;
    rules.name = "ours";
    QVERIFY(game.simulation->setReferee(rules));
    game.runTo(80);
    game.touch({-2.5, 2.0 + game.atTheBall()}, {0.0, 3.0});
    game.runTo(82);
    QCOMPARE(game.game().setPlay(), SetPlay::None);
    QVERIFY(std::abs(game.simulation->snapshot().ball.y) < 3.0);
    game.runTo(200);
    QVERIFY(!game.happened(sim::EventKind::DropBall));
  }

  void aBallThatLiesStillIsDropped() {
    RefereeGame game("humanoid-2021", true);
    game.runTo(60.1);
    QCOMPARE(game.game().state, PlayState::Playing);
    game.runTo(60 + 29);
    QCOMPARE(game.game().state, PlayState::Playing);
    game.runTo(60 + 32);
    QCOMPARE(game.game().state, PlayState::Ready);
    QCOMPARE(game.game().kickOff, Game::noTeam);
    QCOMPARE(game.packet().kickOffRaw, 128);
  }

  void whoStandsInTheOtherHalfBeginsOutside() {
    RefereeGame game("humanoid-2021", true);
    game.runTo(56);
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{1.5, 1.0}, 0.0}));
    game.runTo(64);
    QVERIFY(game.happened(sim::EventKind::Penalised));
    QCOMPARE(game.game().state, PlayState::Playing);
    QVERIFY(std::abs(game.simulation->snapshot().robots[1].pose.position.y) > 3.0);
  }

  void aPenalisedRobotIsPutOutsideAndComesBack() {
    RefereeGame game("humanoid-soccer-2026", true);
    game.runTo(75);
    QVERIFY(game.call(
        {.kind = CallKind::Penalise, .robot = RobotId{2}, .penalty = PenaltyKind::Pushing}));
    game.runTo(79);
    const Pose pose = game.simulation->snapshot().robots[1].pose;
    QVERIFY2(std::abs(pose.position.y) > 3.0, qPrintable(QString::number(pose.position.y)));
    QVERIFY(pose.position.x < 0.0);
    QCOMPARE(game.packet().team(1)->allSlots[1].penalty, 10);
    // A second one of the team lasts ten seconds longer.
    QVERIFY(game.call(
        {.kind = CallKind::Penalise, .robot = RobotId{3}, .penalty = PenaltyKind::Pushing}));
    QCOMPARE(game.game().seconds(game.game().teams[0].players[2].ticksLeft), 55);
  }

  void aDoubleTouchIsAFreeKick_data() {
    QTest::addColumn<QString>("rules");
    QTest::addColumn<bool>("passes");
    QTest::addColumn<bool>("isFoul");
    QTest::newRow("2026") << "humanoid-soccer-2026" << false << true;
    QTest::newRow("2026, after another robot") << "humanoid-soccer-2026" << true << false;
    QTest::newRow("2021") << "humanoid-2021" << false << false;
  }
  void aDoubleTouchIsAFreeKick() {
    QFETCH(QString, rules);
    QFETCH(bool, passes);
    QFETCH(bool, isFoul);
    RefereeGame game(rules.toLatin1().constData(), true);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    start.setPlay = sim::GameStart::Taking{SetPlay::ThrowIn, TeamColor::Blue, Restart::Step::Taking,
                                           Point{-2.5, 2.3}};
    QVERIFY(game.simulation->placeBall({-2.5, 2.0 + game.atTheBall()}));  // blue 2 has it
    QVERIFY(game.simulation->startGame(start));
    game.runTo(0.1);
    const auto touchedBy = [&](int robot, double at) {
      const Point place{-1.0 + at, 0.0};
      QVERIFY(game.simulation->placeBall({place.x, place.y}));
      game.runTo(game.now() + 0.5);
      QVERIFY(game.simulation->placeRobot(RobotId{robot},
                                          {{place.x, place.y - game.atTheBall()}, 0.0}));
      game.runTo(game.now() + 0.1);
      QVERIFY(game.simulation->placeRobot(RobotId{robot}, {{-3.0, -1.5}, 0.0}));
    };
    if (passes) touchedBy(3, 0.5);
    touchedBy(2, 0.0);
    QCOMPARE(game.game().setPlay() == SetPlay::IndirectFreeKick, isFoul);
    if (isFoul) QCOMPARE(game.game().setPlayTeam(), 1);
  }

  void theFourthInTheGoalAreaGoes() {
    RefereeGame game("humanoid-soccer-2026", true);
    QVERIFY(game.simulation->addRobot({RobotId{7}, TeamColor::Blue, 4, false}, {{0, -2.5}, 0}));
    game.commands.resize(7);
    game.percepts.resize(7);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    QVERIFY(game.simulation->startGame(start));
    game.runTo(0.5);
    const double x = -4.2;
    for (const auto& [robot, y] : {std::pair(2, 0.9), std::pair(3, -0.9)}) {
      QVERIFY(game.simulation->placeRobot(RobotId{robot}, {{x, y}, 0.0}));
      game.runTo(game.now() + 0.5);
    }
    game.runTo(game.now() + 2.0);
    QVERIFY(!game.happened(sim::EventKind::Penalised));  // three may
    QVERIFY(game.simulation->placeRobot(RobotId{7}, {{x, 0.45}, 0.0}));
    game.runTo(game.now() + 0.5);
    QVERIFY(!game.happened(sim::EventKind::Penalised));
    game.runTo(game.now() + 1.0);
    QCOMPARE(game.game().teams[0].players[3].penalty, PenaltyKind::IllegalPosition);
    for (const int other : {0, 1, 2}) {
      QCOMPARE(game.game().teams[0].players[std::size_t(other)].penalty, PenaltyKind::None);
    }
  }

  void gettingUpIsNoRemoval() {
    // As adult-size robots: half a second until they notice, then 19.6 s. Lying counts, getting up
    // does not.
    for (const bool getsUp : {true, false}) {
      RefereeGame game("humanoid-2021", true);
      sim::GameStart start;
      start.state = PlayState::Playing;
      start.clock = 300;
      QVERIFY(game.simulation->startGame(start));
      auto& body = std::get<sim::RigidBodyState>(game.simulation->editState().physics).robots[1];
      body.posture = getsUp ? sim::Posture::GettingUp : sim::Posture::OnFront;
      body.getUpRemaining = 25;
      game.runTo(22);
      QCOMPARE(game.game().teams[0].players[1].penalty,
               getsUp ? PenaltyKind::None : PenaltyKind::Incapable);
    }
  }

  void whoComesBackIsNotLeaving() {
    RefereeGame game("humanoid-soccer-2026", true);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    start.robots[RobotId{2}] = {.penalty = PenaltyKind::Pushing, .left = 1.0, .outside = true};
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-3, 3.6}, -1.57}));
    QVERIFY(game.simulation->placeRobot(RobotId{3}, {{1, 2.0}, -1.57}));  // cares for the ball
    QVERIFY(game.simulation->placeBall({1, 1.2}));
    QVERIFY(game.simulation->startGame(start));
    game.runTo(40);
    const GamePlayer& back = game.game().teams[0].players[1];
    QCOMPARE(back.penalty, PenaltyKind::None);
    // Once it was inside, it leaves as everybody else does.
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-3, 2.0}, -1.57}));
    game.runTo(41);
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-3, 3.6}, -1.57}));
    game.runTo(62);
    QCOMPARE(back.penalty, PenaltyKind::Leaving);
  }

  void aRobotIsNotRemovedFromAHeapTwice() {
    RefereeGame game("humanoid-soccer-2026", true);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    QVERIFY(game.simulation->placeBall({-1, 0}));
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-1, 0.4}, 0}));
    QVERIFY(game.simulation->placeRobot(RobotId{3}, {{-1, -0.45}, 0}));
    QVERIFY(game.simulation->startGame(start));
    const GamePlayer& nearest = game.game().teams[0].players[1];
    const GamePlayer& other = game.game().teams[0].players[2];
    game.runTo(10.2);
    QCOMPARE(nearest.penalty, PenaltyKind::LocalStuck);
    QVERIFY(game.call({.kind = CallKind::Pardon, .robot = RobotId{2}}));
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-1, 0.4}, 0}));
    game.runTo(19);
    QCOMPARE(other.penalty, PenaltyKind::None);  // ten seconds more after a removal
    game.runTo(31);
    QCOMPARE(nearest.penalty, PenaltyKind::None);
    QCOMPARE(other.penalty, PenaltyKind::LocalStuck);
  }

  // At the whistle, in the other half: removed, but not while it comes back from a penalty.
  void whoComesBackMayStandAnywhere() {
    for (const bool comesBack : {false, true}) {
      RefereeGame game("humanoid-2014", true);
      sim::GameStart start;
      start.state = PlayState::Ready;
      if (comesBack) {
        start.robots[RobotId{2}] = {.penalty = PenaltyKind::Pushing, .left = 20.0, .outside = true};
      }
      QVERIFY(game.simulation->placeRobot(RobotId{2}, {{1.5, 2.0}, 0.0}));
      QVERIFY(game.simulation->startGame(start));
      game.runTo(31);
      QCOMPARE(game.game().state, PlayState::Set);
      QCOMPARE(game.game().teams[0].players[1].penalty, PenaltyKind::None);
      game.runTo(36);
      QCOMPARE(game.game().state, PlayState::Playing);
      QCOMPARE(game.game().teams[0].players[1].penalty,
               comesBack ? PenaltyKind::None : PenaltyKind::IllegalPosition);
    }
  }

  void aBallIsStuckWhileRobotsAreAtIt() {
    RefereeGame game("humanoid-soccer-2026", true);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    QVERIFY(game.simulation->placeBall({-1, 0}));
    QVERIFY(game.simulation->placeRobot(RobotId{3}, {{-1, -0.9}, 0}));  // cares for it from afar
    QVERIFY(game.simulation->startGame(start));
    const GamePlayer& nearest = game.game().teams[0].players[1];
    game.runTo(15);
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{-1, 0.4}, 0}));
    game.runTo(24.8);  // ten seconds begin when somebody comes
    QCOMPARE(nearest.penalty, PenaltyKind::None);
    game.runTo(25.2);
    QCOMPARE(nearest.penalty, PenaltyKind::LocalStuck);
  }

  void pushing_data() {
    QTest::addColumn<QString>("rules");
    QTest::addColumn<int>("action");
    QTest::addColumn<double>("fromBall");
    QTest::addColumn<double>("seconds");  // until it is called; 0: never
    QTest::addColumn<bool>("removed");
    QTest::addColumn<SetPlay>("kick");
    constexpr int walks = 1, turns = 2, kicks = 4, sidlesOff = 6;
    constexpr double away = 1.0, near = 0.4;
    const auto row = [](const char* name, const char* rules, int action, double from,
                        double seconds, bool removed, SetPlay kick) {
      QTest::newRow(name) << rules << action << from << seconds << removed << kick;
    };
    row("2021", "humanoid-2021", walks, away, 1, true, SetPlay::None);
    row("2021, at the ball", "humanoid-2021", walks, near, 1, false, SetPlay::DirectFreeKick);
    row("2014", "humanoid-2014", walks, away, 4, true, SetPlay::None);
    row("2014, at the ball", "humanoid-2014", walks, near, 4, true, SetPlay::None);
    row("2026", "humanoid-soccer-2026", walks, away, 5, true, SetPlay::None);
    row("2026, at the ball", "humanoid-soccer-2026", walks, near, 5, false,
        SetPlay::DirectFreeKick);
    row("turns", "humanoid-2021", turns, away, 0, false, SetPlay::None);
    row("kicks", "humanoid-2021", kicks, away, 0, false, SetPlay::None);
    row("sidles off", "humanoid-2021", sidlesOff, away, 0, false, SetPlay::None);
  }
  void pushing() {
    QFETCH(QString, rules);
    QFETCH(int, action);
    QFETCH(double, fromBall);
    QFETCH(double, seconds);
    QFETCH(bool, removed);
    QFETCH(SetPlay, kick);
    RefereeGame game(rules.toLatin1().constData(), true);
    sim::GameStart start;
    start.state = PlayState::Playing;
    start.clock = 300;
    QVERIFY(game.simulation->startGame(start));
    const GamePlayer& one = game.game().teams[0].players[1];
    // Blue 2 walks right into red 2 (robot 5), which stands between it and the ball.
    const double x = 0.0;
    const double touching = 2.0 * sim::robotRadius(game.simulation->state(), 0) + 0.005;
    game.commands[1].actionA = action;
    const auto isCalled = [&] {
      return one.penalty != PenaltyKind::None || !game.game().ballFree();
    };
    double called = 0.0;
    while (game.now() < 8.0 && called == 0.0) {
      QVERIFY(game.simulation->placeRobot(RobotId{2}, {{x, 0.0}, 0.0}));
      QVERIFY(game.simulation->placeRobot(RobotId{5}, {{x + touching, 0.0}, 3.14159}));
      QVERIFY(game.simulation->placeBall({x + touching + fromBall, 0.0}));
      game.tick();
      if (isCalled()) called = game.now();
    }
    QVERIFY2(std::abs(called - seconds) < 0.6, qPrintable(QString::number(called)));
    QCOMPARE(one.penalty == PenaltyKind::Pushing, removed);
    QCOMPARE(game.game().restart.kind, kick);
    if (kick != SetPlay::None) QCOMPARE(game.game().restart.team, 1);
  }
};

PITCHBOARD_TEST(TestRefereeJudge)

}  // namespace tst_referee_judge

#include "tst_referee_judge.moc"
