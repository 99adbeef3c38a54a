// SPDX-License-Identifier: GPL-3.0-or-later
// The advisor: what it chooses, that matches with it repeat and can be restored, who listens to it.
#include <QtTest>

#include <cmath>
#include <limits>
#include <numbers>

#include <robotlink/advisor/reference_processes.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/robot_models.h>
#include <simcore/world/published_frame.h>

#include "../support/match_moment.h"
#include "candidates.h"
#include "game_belief.h"
#include "lookahead.h"

namespace tst_advisor {

using namespace pitchboard;
using namespace pitchboard::link;
using std::numbers::pi;

namespace {

const VariableCatalog& words() {
  return VariableCatalog::extended();
}

Scenario scenarioOf(bool advised, std::uint64_t seed = 3) {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.noise = noisePreset("realistic").value();
  scenario.settings.seed = seed;
  scenario.stop = {};
  if (advised) scenario.advisors[TeamColor::Blue];
  return scenario;
}

SimulatedMatch played(const Scenario& scenario, int ticks) {
  auto match = SimulatedMatch::create(scenario, {}).value();
  for (int i = 0; i < ticks; ++i) match.tick();
  return match;
}

int wordOf(const SimulatedMatch& match, int robot, const char* name) {
  return match.blackboard(RobotId{robot})->read(*words().intVar(name));
}

ProcessOptions kidSize(const std::string& behaviour = "striker") {
  ProcessOptions options;
  options.field = sim::fieldByName("kid-2020").value();
  options.model = loadRobotModel("kid-size").value();
  options.behaviour = behaviour;
  options.facesLeft = false;
  return options;
}

/// A robot at the ball, as its process would understand it.
Situation atBall(const Point& ball, double yaw) {
  Situation now;
  now.referee = Referee::Play;
  now.localized = true;
  now.intention = Intention::Ball;
  now.seesBall = true;
  now.ballAge = 0.0;
  now.ball = ball;
  now.pose = {{ball.x - 0.36 * std::cos(yaw), ball.y - 0.36 * std::sin(yaw)}, yaw};
  return now;
}

TeamMate mateAt(const Point& place, Intention intention = Intention::Support) {
  return {place, intention, true, {}};
}

Advice kick(AdviceKind kind, const Point& place) {
  return {kind, {place, 0.0}};
}

/// What a robot does in one cycle after the other.
struct State {
  State() : process(findProcess("decision")->make(options()).value()) {
    const RobotVariables v;
    board.write(v.comReferee, 2);
    board.write(v.localizationBelief, 10.0F);
    board.write(v.visionLost, 1);
    put({{0.0, 0.0}, 0.0});
    actions(1);
  }
  static ProcessOptions options() { return kidSize(); }
  void put(const Pose& pose) {
    const auto cm = sim::published_frame::localizationFromStudio(field, pose);
    const RobotVariables v;
    board.write(v.localizationX, static_cast<int>(std::lround(cm.x)));
    board.write(v.localizationY, static_cast<int>(std::lround(cm.y)));
    board.write(v.localizationTheta, static_cast<int>(std::lround(cm.degrees)));
  }
  void see(double away, double bearing) {
    const RobotVariables v;
    board.write(v.visionLost, 0);
    board.write(v.visionBallDist, static_cast<float>(100.0 * away));
    board.write(v.visionPanDeg, static_cast<float>(bearing * 180.0 / pi));
  }
  /// What a team-mate has reported.
  void tell(const Point& place, Intention intention) {
    const auto cm = sim::published_frame::localizationFromStudio(field, {place, 0.0});
    const auto write = [this](const char* name, int value) {
      board.write(*words().intVar(name), value);
    };
    write("COM_STATE_ROBOT1", 1);
    write("COM_ACTION_ROBOT1", static_cast<int>(intention));
    write("COM_POS_ROBOT1",
          static_cast<int>(std::lround(cm.x)) * 10000 + static_cast<int>(std::lround(cm.y)));
    write("COM_POS_BALL_ROBOT1", -1);
  }
  int word(const char* name) const { return board.read(*words().intVar(name)); }
  void advise(const Advice& advice) {
    variables.write(board, field, advice);
    board.write(variables.stamp, ++stamp);
  }
  /// DECISION_ACTION_A of so many cycles.
  std::vector<int> actions(int cycles) {
    std::vector<int> out;
    for (int i = 0; i < cycles; ++i) {
      process->step(board, {now += 0.1});
      out.push_back(board.read(RobotVariables().decisionActionA));
    }
    return out;
  }
  bool kicks(int cycles) {
    for (const int action : actions(cycles)) {
      if (action == 4 || action == 5 || action == 12 || action == 13 || action == 21 ||
          action == 22) {
        return true;
      }
    }
    return false;
  }

  sim::FieldSpec field = options().field;
  Blackboard board = Blackboard::onHeap();
  AdvisorVariables variables;
  std::unique_ptr<CognitiveProcess> process;
  double now = 0.0;
  int stamp = 0;
};

}  // namespace

class TestAdvisor : public QObject {
  Q_OBJECT
 private slots:
  /// Five set-ups with one obvious best choice; each of 100 seeds chooses it (at least 95).
  void choosesTheObvious_data() {
    QTest::addColumn<int>("setup");
    QTest::newRow("open goal: kick") << 0;
    QTest::newRow("own goal behind: not there") << 1;
    QTest::newRow("touch line: stay in the field") << 2;
    QTest::newRow("keeper out: over to the free side") << 3;
    QTest::newRow("far mate near the goal: pass") << 4;
  }
  void choosesTheObvious() {
    QFETCH(int, setup);
    const ProcessOptions options = kidSize();
    Situation now;
    Candidates candidates{Advice{}};
    const Point goal{4.5, 0.0};
    std::size_t right = 1;
    switch (setup) {
      case 0:  // to leave it alone is worse
        now = atBall({2.5, 0.0}, 0.0);
        candidates = {kick(AdviceKind::Dribble, {0.0, 0.0}), kick(AdviceKind::StrongKick, goal),
                      kick(AdviceKind::Dribble, {2.5, 3.0})};
        break;
      case 1:
        now = atBall({-3.6, 0.0}, 0.6);
        now.opponents = {{-3.0, -0.8}};
        candidates = {kick(AdviceKind::Dribble, {-3.6, -3.0}),
                      kick(AdviceKind::StrongKick, {0.0, 2.4}),
                      kick(AdviceKind::Dribble, {-4.3, 2.0})};
        break;
      case 2:
        now = atBall({3.2, 2.6}, -0.9);
        candidates = {kick(AdviceKind::Dribble, {3.2, 3.0}), kick(AdviceKind::StrongKick, goal),
                      kick(AdviceKind::Dribble, {0.0, 3.0})};
        break;
      case 3:
        now = atBall({3.0, -0.6}, 0.3);
        now.opponents = {{4.3, -0.75}};
        candidates = {kick(AdviceKind::Dribble, {3.0, -3.0}),
                      kick(AdviceKind::StrongKick, {4.5, 0.3}),
                      kick(AdviceKind::Dribble, {0.0, -0.6})};
        break;
      default:
        now = atBall({0.5, 0.0}, 0.35);
        now.opponents = {{0.5, -1.0}};
        now.mates[0] = mateAt({3.2, 1.0});
        candidates = {kick(AdviceKind::Dribble, {-2.0, 0.0}),
                      kick(AdviceKind::StrongKick, {3.3, 1.0}),
                      kick(AdviceKind::Dribble, {0.5, -2.0})};
        break;
    }
    OpponentMemory opponents;
    opponents.update(now.opponents, 0.0);
    auto rollouts = rollout::Rollouts::create(setupFor(options)).value();
    int chosen = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      Lookahead lookahead(beliefOf(now, opponents, 0.0, options), candidates, 100000 * seed,
                          {72, 6.0});
      while (!lookahead.isDone()) lookahead.playOne(rollouts, options.field);
      chosen += lookahead.result().best == right;
    }
    QVERIFY2(chosen >= 95, qPrintable(QString::number(chosen)));
  }

  /// What makes no difference is not thought about for long.
  void aSearchEndsWhenNoActionCanGain() {
    const ProcessOptions options = kidSize();
    const Situation now = atBall({1.0, 0.0}, 0.0);
    auto rollouts = rollout::Rollouts::create(setupFor(options)).value();
    // It goes for the ball anyway.
    const Candidates candidates{Advice{}, kick(AdviceKind::GoToBall, {1.0, 0.0})};
    Lookahead lookahead(beliefOf(now, {}, 0.0, options), candidates, 7, {});
    while (!lookahead.isDone()) lookahead.playOne(rollouts, options.field);
    QCOMPARE(lookahead.played(), 8);
    QCOMPARE(lookahead.result().best, std::size_t{0});
  }

  /// The other team has as many robots, also when this robot has not seen them.
  void unseenOpponentsPlayToo() {
    const ProcessOptions options = kidSize();
    Situation now = atBall({1.0, 0.0}, 0.0);
    now.mates[0] = mateAt({-4.0, 0.0}, Intention::Keep);
    now.mates[1] = mateAt({0.0, 1.0});
    const auto fielders = [&](const Points& seen) {
      OpponentMemory opponents;
      opponents.update(seen, 0.0);
      const rollout::Belief belief = beliefOf(now, opponents, 0.0, options);
      std::vector<double> sigmas;
      for (std::size_t i = firstTheirs; i < allPlayers; ++i) {
        if (!belief.robots[i].absent) sigmas.push_back(belief.robots[i].sigma);
      }
      return sigmas;
    };
    QCOMPARE(fielders({}).size(), std::size_t{2});
    const auto one = fielders({{2.0, 0.0}});
    QCOMPARE(one.size(), std::size_t{2});
    QVERIFY(one[0] < 0.3 && one[1] > 0.5);
    QCOMPARE(fielders({{2.0, 0.0}, {0.5, 0.5}, {0.0, -1.0}}).size(), std::size_t{3});
  }

  /// A ball that is out comes back where the rules say: a missed shot costs most of the field.
  void ballOutCountsAsItsRestart() {
    const sim::FieldSpec field = kidSize().field;
    const auto valueAt = [&](const Point& ball, std::size_t touched) {
      std::array<double, rollout::columnCount> row{};
      const auto put = [&row](rollout::Column column, double value) {
        row[static_cast<std::size_t>(column)] = value;
      };
      put(rollout::Column::EndedBy, static_cast<double>(rollout::Ended::BallOut));
      put(rollout::Column::BallX, ball.x);
      put(rollout::Column::BallY, ball.y);
      put(rollout::Column::LastTouch, static_cast<double>(touched));
      return valueOfRow(row, field);
    };
    const double missed = valueAt({4.6, 2.0}, ownPlayer), corner = valueAt({4.6, 2.0}, firstTheirs);
    QVERIFY(missed < 0.0);
    QVERIFY(corner > 0.1);
    QCOMPARE(valueAt({-4.6, -2.0}, firstTheirs), -missed);
    const double thrown = valueAt({2.0, 3.1}, ownPlayer);
    QVERIFY(thrown < valueAt({2.0, 3.1}, firstTheirs) && thrown > missed);
  }

  void matchesRepeat() {
    constexpr int ticks = 2400;
    int differ = 0;  // from the match without: most thoughts find nothing better
    for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
      const SimulatedMatch one = played(scenarioOf(true, seed), ticks),
                           other = played(scenarioOf(true, seed), ticks);
      QCOMPARE(one.simulation().hash(), other.simulation().hash());
      QVERIFY(wordOf(one, 1, "ADVISOR_STAMP") > 0);
      QCOMPARE(wordOf(one, 4, "ADVISOR_STAMP"), 0);  // of the other team
      differ +=
          played(scenarioOf(false, seed), ticks).simulation().hash() != one.simulation().hash();
    }
    QVERIFY(differ > 0);
  }

  void itPublishesItsCandidates() {
    auto match = played(scenarioOf(true), 60);
    int lookaheads = 0, last = 0;
    for (int i = 0; i < 1800; ++i) {
      match.tick();
      const int stamp = wordOf(match, 1, "ADVISOR_STAMP");
      if (stamp == last) continue;
      QCOMPARE(stamp, last + 1);
      last = stamp;
      ++lookaheads;
      const int candidates = wordOf(match, 1, "ADVISOR_CANDIDATES");
      QVERIFY(wordOf(match, 1, "ADVISOR_ROLLOUTS") >= 4 * candidates);
      QVERIFY(candidates >= 2 && candidates <= 6);
      QCOMPARE(wordOf(match, 1, "ADVISOR_CANDIDATE1") / 100000000, 0);
      QVERIFY(wordOf(match, 1, "ADVISOR_CANDIDATE2") >= 100000000);
      std::uint32_t most = 0;
      for (int word = 1; word <= 20; ++word) {
        const QByteArray name = QString("ADVISOR_HEAT%1").arg(word, 2, 10, QChar('0')).toUtf8();
        for (auto cells = std::uint32_t(wordOf(match, 1, name)); cells != 0; cells >>= 4) {
          most = std::max(most, cells & 15U);
        }
      }
      QCOMPARE(most, 15U);
    }
    QVERIFY(lookaheads > 3);
  }

  /// A moment in the middle of a thought goes on as the match did.
  void aSearchIsContinuedAfterRestoring() {
    SimulatedMatch match = played(scenarioOf(true), 300);
    for (int i = 0; i < 3000 && wordOf(match, 1, "ADVISOR_STATE") != 2; ++i) match.tick();
    QCOMPARE(wordOf(match, 1, "ADVISOR_STATE"), 2);
    const Moment moment = momentOf(match);
    std::vector<std::uint64_t> later;
    for (int i = 0; i < 600; ++i) {
      match.tick();
      later.push_back(match.simulation().hash());
    }
    QVERIFY(match.restore(moment));
    for (const std::uint64_t hash : later) {
      match.tick();
      QCOMPARE(match.simulation().hash(), hash);
    }
  }

  void freshAdviceIsTaken() {
    State player;
    player.put({{2.0, 0.0}, 0.0});
    player.see(0.30, 0.2);
    QVERIFY(player.kicks(30));
    State advised;
    advised.put({{2.0, 0.0}, 0.0});
    advised.see(0.30, 0.2);
    for (int i = 0; i < 3; ++i) {
      advised.advise(kick(AdviceKind::Dribble, {4.5, 0.0}));
      QVERIFY(!advised.kicks(10));
    }
    QVERIFY(advised.kicks(40));  // nobody says it again
  }

  void adviceSendsARobotToTheBallOrToAPlace() {
    const auto mindWith = [](const Point& mate, Intention intention) {
      State player;
      player.see(1.0, 0.0);
      player.tell(mate, intention);
      player.actions(5);
      return player;
    };
    const Advice leave = kick(AdviceKind::LeaveBall, {1.0, 0.0});
    const Advice go = kick(AdviceKind::GoToBall, {1.0, 0.0});
    State first = mindWith({-2.0, 0.5}, Intention::Support);
    QCOMPARE(first.word("DECISION_STATE"), static_cast<int>(Intention::Ball));
    first.advise(leave);
    first.actions(3);
    QCOMPARE(first.word("DECISION_STATE"), static_cast<int>(Intention::Support));
    // None else would go.
    State alone = mindWith({-2.0, 0.5}, Intention::Idle);
    alone.advise(leave);
    alone.actions(3);
    QCOMPARE(alone.word("DECISION_STATE"), static_cast<int>(Intention::Ball));

    State second = mindWith({0.7, 0.1}, Intention::Ball);
    QCOMPARE(second.word("DECISION_STATE"), static_cast<int>(Intention::Support));
    second.advise(go);
    second.actions(3);
    QCOMPARE(second.word("DECISION_STATE"), static_cast<int>(Intention::Ball));
    second.actions(20);  // nobody says it again
    QCOMPARE(second.word("DECISION_STATE"), static_cast<int>(Intention::Support));
    second.advise({AdviceKind::Stand, {{-1.0, 1.0}, 0.0}});
    second.actions(3);
    QCOMPARE(second.word("DECISION_POSITION_A"), 350);
    QCOMPARE(second.word("DECISION_POSITION_B"), 200);
  }

  /// As without: advice that nobody renews, of an earlier program, and numbers without sense.
  void staleAndHostileValuesMoveNoRobot_data() {
    QTest::addColumn<int>("choice");
    QTest::addColumn<float>("x");
    QTest::addColumn<bool>("renewed");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("stale") << 3 << 450.0F << false;
    QTest::newRow("NaN") << 3 << nan << true;
    QTest::newRow("infinite") << 1 << std::numeric_limits<float>::infinity() << true;
    QTest::newRow("far") << 1 << 1e9F << true;
    QTest::newRow("beside the field") << 3 << 2000.0F << true;
    QTest::newRow("no such choice") << 7 << 450.0F << true;
    QTest::newRow("negative choice") << -1 << 450.0F << true;
    QTest::newRow("to the own goal") << 1 << 0.0F << true;
  }
  void staleAndHostileValuesMoveNoRobot() {
    QFETCH(int, choice);
    QFETCH(float, x);
    QFETCH(bool, renewed);
    State usual, advised;
    for (State* player : {&usual, &advised}) {
      player->put({{-1.0, 0.5}, 0.1});
      player->see(0.30, 0.1);
    }
    for (int i = 0; i < 60; ++i) {
      if (i == 0 || renewed) {
        advised.board.write(advised.variables.choice, choice);
        advised.board.write(advised.variables.x, x);
        advised.board.write(advised.variables.y, 300.0F);
        advised.board.write(advised.variables.stamp, i == 0 ? 77 : 77 + i);
      }
      QCOMPARE(advised.actions(1), usual.actions(1));
    }
  }

  /// When no match waits for it, it plays what its share of a core allows, and also comes to an
  /// end.
  void itRunsFreely() {
    State player;
    player.put({{2.5, 0.0}, 0.0});
    player.see(0.4, 0.0);
    ProcessOptions options = kidSize();
    options.advisor.share = 0.25;
    const auto advisor = findProcess("advisor")->make(options).value();
    for (int i = 0; i < 30; ++i) {
      // It stands where it is, and stays at the ball.
      player.board.write(*words().intVar("DECISION_STATE"), static_cast<int>(Intention::Ball));
      advisor->step(player.board, {0.1 * i});
    }
    QVERIFY(player.word("ADVISOR_STAMP") >= 2);
    QVERIFY(player.word("ADVISOR_ROLLOUTS") >= 12);
    QVERIFY(player.word("ADVISOR_CANDIDATES") >= 3);
  }

  /// While a match is played, and back again.
  void teamsBeginAndEndToThinkAhead() {
    auto match = played(scenarioOf(false), 60);
    const auto lookaheads = [&](int ticks) {
      const int before = wordOf(match, 1, "ADVISOR_STAMP");
      for (int i = 0; i < ticks; ++i) match.tick();
      return wordOf(match, 1, "ADVISOR_STAMP") - before;
    };
    QCOMPARE(lookaheads(1200), 0);
    QVERIFY(match.robots().setAdvisor(TeamColor::Blue, AdvisorOptions{}));
    QVERIFY(lookaheads(2400) > 0);
    QCOMPARE(wordOf(match, 4, "ADVISOR_STAMP"), 0);  // of the other team
    QVERIFY(match.toScenario().advisors.contains(TeamColor::Blue));
    // Numbers that cannot be used change nothing.
    QVERIFY(!match.robots().setAdvisor(TeamColor::Blue, AdvisorOptions{.rollouts = 0}));
    QVERIFY(match.toScenario().advisors.at(TeamColor::Blue) == AdvisorOptions{});
    QVERIFY(lookaheads(2400) > 0);
    QVERIFY(match.robots().setAdvisor(TeamColor::Blue, {}));
    QCOMPARE(wordOf(match, 1, "ADVISOR_STATE"), 0);
    QCOMPARE(lookaheads(2400), 0);
    QVERIFY(match.toScenario().advisors.empty());
  }

  void refusesOptions() {
    for (const AdvisorOptions& wrong :
         {AdvisorOptions{.rollouts = 0}, {.horizon = std::nan("")}, {.share = 2.0}}) {
      ProcessOptions options = kidSize();
      options.advisor = wrong;
      QVERIFY(!findProcess("advisor")->make(options));
    }
  }

  void scenariosSetTheAdvisor() {
    const auto read = [](const char* teams) {
      return scenarioFromJson(QString(R"({"version": 1, "teams": %1})").arg(teams).toStdString(),
                              "test");
    };
    const auto scenario = read(
        R"([{"colour": "blue", "advisor": {"rollouts": 40}}, {"colour": "red", "advisor": true}])");
    QVERIFY(scenario);
    QCOMPARE(scenario->advisors.at(TeamColor::Blue).rollouts, 40);
    QVERIFY(scenario->advisors.at(TeamColor::Red) == AdvisorOptions{});
    QVERIFY(scenarioFromJson(scenarioToJson(*scenario), "again").value() == *scenario);
    QVERIFY(read(R"([{"colour": "blue", "advisor": false}])")->advisors.empty());
    QVERIFY(!read(R"([{"colour": "blue", "advisor": 3}])"));
    QVERIFY(!read(R"([{"colour": "blue", "advisor": {"rollouts": 3}}])"));
    QVERIFY(!read(R"([{"colour": "blue", "advisor": {"share": 0.5}}])"));
  }
};

PITCHBOARD_TEST(TestAdvisor)

}  // namespace tst_advisor

#include "tst_advisor.moc"
