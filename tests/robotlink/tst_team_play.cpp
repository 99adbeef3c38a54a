// SPDX-License-Identifier: GPL-3.0-or-later
// How the robots of a team share the work: who goes for the ball, where the others stand, which
// kick is chosen. From blackboards, without a match.
#include <QtTest>

#include <numbers>
#include <random>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/cognition/soccer_player.h>
#include <robotlink/models/robot_models.h>
#include <simcore/world/published_frame.h>

#include "planning/target.h"
#include "soccer/kick_choice.h"
#include "soccer/roles.h"
#include "soccer/soccer_board.h"

namespace tst_team_play {

using namespace pitchboard;
using namespace pitchboard::link;
using std::numbers::pi;

namespace {

const sim::FieldSpec& kidField() {
  static const sim::FieldSpec field = [] {
    sim::FieldSpec all = sim::fieldByName("kid-2020").value();
    all.robotRadius = loadRobotModel("kid-size").value().radius;
    return all;
  }();
  return field;
}

/// A robot that attacks towards +x, and what stands on its blackboard.
struct Robot {
  Robot() {
    board.write(variables.comReferee, 2);
    board.write(variables.localizationBelief, 5.0F);
    hideBall();
  }
  sim::published_frame::CmPose cm(const Point& at, double yaw = 0.0) const {
    return sim::published_frame::localizationFromStudio(kidField(), {at, yaw});
  }
  void stand(const Pose& at) {
    pose = at;
    const auto place = cm(at.position, at.yaw);
    board.write(variables.localizationX, static_cast<int>(std::lround(place.x)));
    board.write(variables.localizationY, static_cast<int>(std::lround(place.y)));
    board.write(variables.localizationTheta, static_cast<int>(std::lround(place.degrees)));
    board.write(variables.imuEulerZ, static_cast<float>(at.yaw));
  }
  void hideBall() { board.write(variables.visionLost, 1); }
  void see(const Point& ball) {
    const double way = direction(pose.position, ball) - pose.yaw;
    board.write(variables.visionLost, 0);
    board.write(variables.visionBallDist, static_cast<float>(100 * distance(pose.position, ball)));
    board.write(variables.visionPanDeg, static_cast<float>(way * 180 / pi));
  }
  void mate(int n, const Point& at, Intention intention) {
    const auto place = cm(at);
    const auto i = static_cast<std::size_t>(n);
    board.write(team.state[i], static_cast<int>(MateState::Active));
    board.write(team.action[i], static_cast<int>(intention));
    board.write(team.place[i], packPlace(static_cast<int>(place.x), static_cast<int>(place.y)));
    board.write(team.ball[i], -1);
  }
  void opponent(const Point& at) { seen = at; }
  /// A second of cycles, in which it also looks at others.
  void look(WorldModel& world) {
    for (int i = 0; i < 20; ++i) {
      if (seen && board.read(variables.decisionActionVision) == 2) {
        board.write(variables.robotDist[0],
                    static_cast<float>(100 * distance(pose.position, *seen)));
        board.write(variables.robotAngle[0],
                    static_cast<float>((pose.yaw - direction(pose.position, *seen)) * 180 / pi));
      }
      now += 0.1;
      SoccerInput input;
      soccer.read(board, world, input);
      world.update(input, now);
      soccer.lookFor(board, world.looksForOpponents());
    }
  }
  WorldModel model() {
    WorldModel world(kidField(), loadRobotModel("kid-size").value(), {}, false);
    look(world);
    return world;
  }
  /// What its decision process says after a second.
  Intention intention(const std::string& behaviour) {
    ProcessOptions options;
    options.behaviour = behaviour;
    options.facesLeft = false;
    options.field = kidField();
    options.model = loadRobotModel("kid-size").value();
    const auto decision = findProcess("decision")->make(options).value();
    for (int i = 0; i < 10; ++i) {
      now += 0.1;
      decision->step(board, {now});
    }
    return reported();
  }
  Intention reported() const { return static_cast<Intention>(board.read(team.intention)); }

  Blackboard board = Blackboard::onHeap();
  RobotVariables variables{VariableCatalog::extended()};
  TeamVariables team;
  SoccerBoard soccer;
  Pose pose;
  std::optional<Point> seen;
  double now = 0.0;
};

}  // namespace

class TestTeamPlay : public QObject {
  Q_OBJECT

 private slots:
  void supportersKeepApart() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(-4.4, 4.4), across(-2.9, 2.9);
    for (int i = 0; i < 30; ++i) {
      const Point ball{along(random), across(random)};
      for (const std::size_t robots : {1U, 2U, 3U, 9U}) {
        const auto places = placingsFor(kidField(), ball, ball.y > 0 ? -1 : 1, 2.0, robots);
        QCOMPARE(places.size(), robots);
        for (std::size_t a = 0; a < places.size(); ++a) {
          QVERIFY(std::abs(places[a].place.x) < kidField().halfLength());
          QVERIFY(std::abs(places[a].place.y) < kidField().halfWidth());
          QVERIFY(distance(places[a].place, ball) >= placesApart);
          for (std::size_t b = 0; b < a; ++b)
            QVERIFY(distance(places[a].place, places[b].place) >= placesApart);
        }
      }
    }
  }

  // AllPrograms works out the same: no place is taken twice.
  void everyPlaceHasOneRobot() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> along(-4.4, 4.4), across(-2.9, 2.9);
    for (int i = 0; i < 30; ++i) {
      std::vector<Point> robots, places;
      for (int n = 0; n < 3; ++n) {
        robots.push_back({along(random), across(random)});
        places.push_back({along(random), across(random)});
      }
      std::vector<std::size_t> taken;
      for (std::size_t n = 0; n < robots.size(); ++n) {
        std::vector<Point> seen = robots;
        std::swap(seen[0], seen[n]);  // this robot first
        taken.push_back(placeOf(seen, places));
      }
      std::ranges::sort(taken);
      QVERIFY(std::ranges::adjacent_find(taken) == taken.end());
    }
  }

  void elevenHavePlaces() {
    for (const sim::FieldSpec& field : sim::builtInFields()) {
      const auto places = kickOffPlaces(field);
      QCOMPARE(places.size(), std::size_t{10});
      for (std::size_t a = 0; a < places.size(); ++a) {
        QVERIFY(places[a].x < -0.3 && places[a].x > -field.halfLength());
        QVERIFY(std::abs(places[a].y) < field.halfWidth() - 0.3);
        QVERIFY(length(places[a]) > field.centreCircleDiameter / 2 + 0.3);
        for (std::size_t b = 0; b < a; ++b) QVERIFY(distance(places[a], places[b]) > 0.8);
      }
    }
  }

  void theBallIsMetWhereItStops() {
    BallTrack track;
    const auto roll = [&](double speed, double from) {
      for (int i = 0; i <= 8; ++i) track.see({from + 0.1 * i * speed, 1.0}, 1.0, 10.0 + 0.1 * i);
    };
    roll(1.0, 0.0);
    const Point here{0.8, 1.0};
    const Point stops = track.stopsAt(here, kidField(), 10.8);
    QVERIFY2(std::abs(stops.x - here.x - 1.0 / 0.6) < 0.05, qPrintable(QString::number(stops.x)));
    QCOMPARE(stops.y, 1.0);
    // At the lines at the latest.
    QCOMPARE(track.stopsAt({4.0, 1.0}, kidField(), 10.8).x, kidField().halfLength());
    // What was seen longer ago says nothing.
    QCOMPARE(track.velocity(13.0), Velocity{});
    // Nor does a ball that seems to move no more than the camera errs.
    BallTrack still;
    for (int i = 0; i <= 8; ++i) still.see({i % 2 ? 0.1 : -0.1, 0.0}, 3.0, 0.1 * i);
    QCOMPARE(still.velocity(0.8), Velocity{});
  }

  // Time counts, not metres: who would have to turn round and go round the ball leaves it.
  void oneClosestGoes() {
    Robot robot;
    robot.stand({{-1.0, 0.0}, 0.0});
    robot.see({0.5, 0.0});
    robot.mate(0, {-1.2, 0.0}, Intention::Support);
    QCOMPARE(robot.intention("striker"), Intention::Ball);
    Robot behind;
    behind.stand({{1.5, 0.0}, pi});
    behind.see({0.5, 0.0});
    behind.mate(0, {-0.9, 0.0}, Intention::Ball);
    QCOMPARE(behind.intention("striker"), Intention::Support);
    // A team-mate that has turned away, or serves a penalty, does not keep it from the ball.
    Robot alone;
    alone.stand({{-1.0, 0.0}, 0.0});
    alone.see({0.5, 0.0});
    alone.mate(0, {0.2, 0.0}, Intention::Idle);
    QCOMPARE(alone.intention("supporter"), Intention::Ball);
  }

  void theKeeperComesOut() {
    const double line = -kidField().halfLength();
    Robot keeper;
    keeper.stand({{line + 0.5, 0.0}, 0.0});
    keeper.see({line + 2.2, 0.0});
    QCOMPARE(keeper.intention("keeper"), Intention::Ball);
    Robot stays;
    stays.stand({{line + 0.5, 0.0}, 0.0});
    stays.see({line + 2.2, 0.0});
    stays.mate(0, {line + 1.6, 0.0}, Intention::Ball);
    QCOMPARE(stays.intention("keeper"), Intention::Keep);
    Robot far;
    far.stand({{line + 0.5, 0.0}, 0.0});
    far.see({line + 3.5, 0.0});
    QCOMPARE(far.intention("keeper"), Intention::Keep);
  }

  void aCoveredGoalIsPassed() {
    Robot robot;
    robot.stand({{1.0, 0.0}, 0.0});
    const Point ball{1.3, 0.05};
    robot.see(ball);
    const auto choice = [&](Robot& one) {
      const WorldModel world = one.model();
      return chooseKick(world, {}, {ball});
    };
    const auto free = choice(robot);
    QVERIFY(free && free->act == acts::kickLeft);  // the goal is open: a shot
    robot.opponent({1.9, 0.0});
    QVERIFY(!choice(robot));  // nobody to pass to
    robot.mate(0, {1.3, 1.5}, Intention::Support);
    const auto pass = choice(robot);
    QVERIFY(pass && pass->act == acts::passLeft);
    QVERIFY(pass->stops.y > 1.5);
    robot.mate(0, {1.3, -1.5}, Intention::Idle);  // takes no part
    QVERIFY(!choice(robot));
  }

  void clearsBeforeTheOwnGoal() {
    Robot robot;
    robot.stand({{-3.6, 0.3}, 0.5});
    const Point ball{-3.3, 0.45};
    robot.see(ball);
    robot.opponent({-2.6, 0.9});
    const WorldModel world = robot.model();
    QVERIFY(!chooseKick(world, {}, {ball}));
    const auto away = chooseKick(world, {}, {ball, true});
    QVERIFY(away);
    QVERIFY(away->stops.x > ball.x);
    // Never towards its own goal.
    Robot turned;
    turned.stand({{-3.0, 0.4}, pi});
    turned.see(ball);
    QVERIFY(!chooseKick(turned.model(), {}, {ball, true}) ||
            chooseKick(turned.model(), {}, {ball, true})->stops.x > -4.0);
  }

  void whoComesBackEntersFirst() {
    Robot robot;
    robot.stand({{-2.0, 3.6}, -pi / 2});
    robot.board.write(robot.variables.comReferee, 1);
    ProcessOptions options;
    options.facesLeft = false;
    options.field = kidField();
    options.model = loadRobotModel("kid-size").value();
    const auto decision = findProcess("decision")->make(options).value();
    const auto cycles = [&](int count) {
      for (int i = 0; i < count; ++i) {
        robot.now += 0.1;
        decision->step(robot.board, {robot.now});
      }
    };
    cycles(10);
    robot.board.write(robot.variables.comReferee, 2);
    cycles(3);
    const auto target = TargetVariables().read(robot.board, kidField());
    QVERIFY(target.has_value());
    QVERIFY(std::abs(target->pose.position.x + 2.0) < 0.05);
    QVERIFY(target->pose.position.y < kidField().halfWidth() - 0.5);
    // On the field it plays.
    robot.stand({{-2.0, 2.6}, -pi / 2});
    robot.see({0.0, 0.0});
    cycles(3);
    QCOMPARE(static_cast<Intention>(robot.board.read(robot.team.intention)), Intention::Ball);
  }

  void readyIsWalkedForwards() {
    Robot robot;
    robot.stand({{0.8, 1.0}, 0.0});  // its place lies behind it
    robot.board.write(robot.variables.comReferee, 11);
    (void)robot.intention("striker");
    const auto target = TargetVariables().read(robot.board, kidField());
    QVERIFY(target && target->forwards);
    ProcessOptions options;
    options.field = kidField();
    options.model = loadRobotModel("kid-size").value();
    const auto planning = findProcess("planning")->make(options).value();
    planning->step(robot.board, {robot.now});
    const int turns = robot.board.read(robot.variables.decisionActionA);
    QVERIFY(turns == acts::turnLeft.action || turns == acts::turnRight.action);
  }

  void theTakerGoesToTheBall_data() {
    QTest::addColumn<int>("setPlay");
    QTest::addColumn<Point>("place");
    const double l = kidField().halfLength(), w = kidField().halfWidth();
    QTest::newRow("goal kick") << static_cast<int>(SetPlay::GoalKick) << Point{0.0, w};
    QTest::newRow("corner kick") << static_cast<int>(SetPlay::CornerKick) << Point{l, w};
    QTest::newRow("penalty kick") << static_cast<int>(SetPlay::PenaltyKick)
                                  << Point{l - kidField().penaltyMarkDistance, 0.0};
  }
  void theTakerGoesToTheBall() {
    QFETCH(int, setPlay);
    QFETCH(Point, place);
    Robot robot;
    robot.stand({{-2.0, 1.0}, 0.0});
    const VariableCatalog& map = VariableCatalog::extended();
    robot.board.write(*map.intVar("COM_SET_PLAY"), setPlay);
    robot.board.write(*map.intVar("COM_SET_PLAY_OURS"), 1);
    ProcessOptions options;
    options.facesLeft = false;
    options.field = kidField();
    options.model = loadRobotModel("kid-size").value();
    const auto decision = findProcess("decision")->make(options).value();
    for (int i = 0; i < 100; ++i) {  // beyond the search with the head
      robot.now += 0.1;
      decision->step(robot.board, {robot.now});
    }
    const auto target = TargetVariables().read(robot.board, kidField());
    QVERIFY(target.has_value());
    // Of two places either.
    QVERIFY(std::abs(target->pose.position.x - place.x) < 0.02);
    QVERIFY(std::abs(std::abs(target->pose.position.y) - place.y) < 0.02);
  }

  /// A SoccerPlayer decides as the processes decision and planning do from the same blackboard.
  void playersWithoutABlackboardDecideAlike() {
    const Pose poses[] = {{{-1, 0.3}, 0.2}, {{1.5, -1}, 2.5}, {{-4, 0.5}, -0.4}, {{0.5, 0}, 0.1}};
    const Point balls[] = {{0.8, 0}, {-2.5, 0.7}};
    for (const char* behaviour : {"striker", "supporter", "keeper"}) {
      for (const Pose& pose : poses) {
        for (const Point& ball : balls) {
          Robot robot;
          robot.stand(pose);
          robot.see(ball);
          robot.mate(0, {-1, 2}, Intention::Support);
          ProcessOptions options;
          options.behaviour = behaviour;
          options.facesLeft = false;
          options.field = kidField();
          options.model = loadRobotModel("kid-size").value();
          const auto decision = findProcess("decision")->make(options).value();
          const auto planning = findProcess("planning")->make(options).value();
          auto player =
              SoccerPlayer::create({options.field, options.model, {behaviour, {}}, false}).value();
          WorldModel world(kidField(), options.model, {}, false);
          for (int cycle = 0; cycle < 30; ++cycle) {
            robot.now += SoccerPlayer::period;
            SoccerInput input;
            robot.soccer.read(robot.board, world, input);
            world.update(input, robot.now);
            const PlayerDecision decided = player.step(input, robot.now);
            decision->step(robot.board, {robot.now});
            planning->step(robot.board, {robot.now});
            QCOMPARE(decided.act.action, robot.board.read(robot.variables.decisionActionA));
            QCOMPARE(decided.intention, robot.reported());
            QCOMPARE(decided.looksForOpponents,
                     robot.board.read(robot.variables.decisionActionVision) == 2);
            robot.board.write(robot.variables.controlAction, decided.act.action);
          }
        }
      }
    }
  }
};

PITCHBOARD_TEST(TestTeamPlay)

}  // namespace tst_team_play

#include "tst_team_play.moc"
