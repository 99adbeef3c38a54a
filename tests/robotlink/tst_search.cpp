// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that has lost the ball: it goes where it saw it last, wherever that is, and looks round
// the whole field when it is not there. Nothing but its own eyes tells it where the ball is.
#include <QtTest>

#include "../support/measured_match.h"

namespace tst_search {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr double tickRate = 60.0;
constexpr double seesFar = 3.0;        // m, the published robot
constexpr double walkingSpeed = 0.18;  // m/s, the same
constexpr double reached = 0.6;        // m between the centres: about to go round it

/// One robot; the referee lets it stand, walk to its kick-off place, and play.
struct Game {
  Game(const char* behaviour, const Pose& pose, const Point& ball, const char* noise,
       double playFrom)
      : match(make(behaviour, pose, ball, noise, playFrom)) {}

  static SimulatedMatch make(const char* behaviour, const Pose& pose, const Point& ball,
                             const char* noise, double playFrom) {
    Scenario scenario = soccerMatch(noise, 5).value();
    scenario.robots.resize(1);
    ScenarioRobot& robot = scenario.robots[0];
    robot.identity = {RobotId{1}, TeamColor::Blue, 1, false};
    robot.pose = pose;
    robot.behaviour = behaviour;
    scenario.ball = ball;
    // Standing it finds out where it is and sees the ball, then it walks away.
    scenario.writes = {{RobotId{}, "COM_REFEREE", 1.0, 0.0},
                       {RobotId{}, "COM_REFEREE", 11.0, 10.0},
                       {RobotId{}, "COM_REFEREE", 2.0, playFrom}};
    MatchOptions options;
    options.process.particles = 1000;
    return SimulatedMatch::create(scenario, options).value();
  }

  double now() const { return static_cast<double>(match.simulation().state().tick) / tickRate; }
  Point robot() const { return match.simulation().robotPose(RobotId{1}).value().position; }
  Point ball() const { return match.simulation().snapshot().ball; }
  bool sees() const {
    return match.blackboard(RobotId{1})->read(match.variables().visionLost) == 0;
  }
  double away() const { return distance(robot(), ball()); }
  void playTo(double seconds) {
    while (now() < seconds) match.tick();
  }

  SimulatedMatch match;
};

}  // namespace

class TestSearch : public QObject {
  Q_OBJECT
 private slots:
  void itGoesWhereItSawTheBallLast_data() {
    QTest::addColumn<QString>("behaviour");
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<QString>("noise");
    for (const char* noise : {"none", "realistic"}) {
      QTest::addRow("own left corner, %s", noise) << "striker" << -4.2 << 2.6 << noise;
      QTest::addRow("own right corner, %s", noise) << "striker" << -4.2 << -2.6 << noise;
      QTest::addRow("their left corner, %s", noise) << "supporter" << 4.2 << 2.6 << noise;
      QTest::addRow("their right corner, %s", noise) << "supporter" << 4.2 << -2.6 << noise;
    }
  }
  void itGoesWhereItSawTheBallLast() {
    QFETCH(QString, behaviour);
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(QString, noise);
    const Point lost{x, y};
    const Pose beside{{0.6 * x, 0.4 * y}, x > 0 ? 0.0 : 3.14};
    const double begins = x > 0 ? 34.0 : 28.0;
    Game game(qPrintable(behaviour), beside, lost, qPrintable(noise), begins);
    game.playTo(begins);
    QVERIFY(distance(game.ball(), lost) < 0.01);
    QVERIFY2(game.away() > seesFar, qPrintable(QString::number(game.away())));
    // It looks about first. Then the straight way, with half of it for turns and detours, and one
    // sweep of the head.
    const double looks = 12.0 + 6.0;
    const auto walks = [](double way) { return 1.5 * std::max(0.0, way) / walkingSpeed; };
    const double start = game.away();
    const double seesBy = looks + walks(start - seesFar), reachesBy = looks + walks(start);
    double toCentre = 1e9;
    while (!game.sees() && game.now() < begins + seesBy) {
      game.match.tick();
      toCentre = std::min(toCentre, length(game.robot()));
    }
    const double saw = game.now() - begins;
    QVERIFY2(game.sees(), qPrintable(QString::number(game.away())));
    QVERIFY2(toCentre > 1.0, qPrintable(QString::number(toCentre)));
    while (game.away() > reached && game.now() < begins + reachesBy) game.match.tick();
    qInfo("%.1f m away: seen after %.0f s (of %.0f), reached after %.0f s (of %.0f)", start, saw,
          seesBy, game.now() - begins, reachesBy);
    QVERIFY2(game.away() <= reached, qPrintable(QString::number(game.away())));
  }

  // It lies in the opposite corner by now.
  void whatIsNotThereIsLookedForEverywhere() {
    const Point lost{-4.2, 2.6}, really{4.2, -2.6};
    Game game("striker", {{-2.5, 1.0}, 3.14}, lost, "realistic", 28.0);
    game.playTo(28.0);
    QVERIFY(game.away() > seesFar);
    QVERIFY(game.match.simulation().placeBall(really));
    double nearestToLost = 1e9;
    while (game.now() < 28.0 + 300.0 && game.away() > reached) {
      game.match.tick();
      nearestToLost = std::min(nearestToLost, distance(game.robot(), lost));
    }
    qInfo("%.0f s, %.2f m to where it was lost", game.now() - 28.0, nearestToLost);
    QVERIFY(game.away() <= reached);
    QVERIFY(nearestToLost < seesFar);
  }
};

PITCHBOARD_TEST(TestSearch)

}  // namespace tst_search

#include "tst_search.moc"
