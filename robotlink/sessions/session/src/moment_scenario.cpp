// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/moment_scenario.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <set>

#include <base/ids.h>
#include <base/team_color.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/live/board_columns.h>
#include <robotlink/match/referee_packet.h>
#include <robotlink/scenario/moment_writes.h>
#include <simcore/world/limits.h>
#include <simcore/world/places.h>

namespace pitchboard::link {
namespace {

constexpr double gap = 0.01;    // m between robots that were pushed apart
constexpr int maxPushes = 400;  // rounds; a crowd that needs more stays as it is

class Maker {
 public:
  Maker(const MatchFrame& frame, const MomentOptions& options)
      : m_frame(frame), m_options(options) {}

  MomentScenario make() {
    takeSettings();
    takeRobots();
    pushApart();
    takeBall();
    takeGame();
    m_out.scenario.writes.insert(m_out.scenario.writes.begin(), m_boards.begin(), m_boards.end());
    return std::move(m_out);
  }

 private:
  void note(std::string text) { m_out.notes.push_back(std::move(text)); }
  bool believed() const {
    return !m_frame.truthKnown || m_options.poses == MomentOptions::Poses::Believed;
  }

  void takeSettings() {
    Scenario& scenario = m_out.scenario;
    if (m_options.base) scenario = *m_options.base;
    scenario.robots.clear();
    scenario.stop.duration.reset();
    char time[32];
    std::snprintf(time, sizeof time, "%.1f", m_frame.snapshot.time);
    const std::string title = !scenario.title.empty()               ? scenario.title
                              : m_options.base                      ? scenario.name
                              : m_frame.origin == FrameOrigin::Live ? std::string("Live")
                                                                    : std::string("Recorded match");
    scenario.title = title + ", at " + time + " s";
    if (!m_options.base) scenario.name = "moment";
    sim::SimulationSettings& settings = scenario.settings;
    if (sim::validate(m_frame.settings->field)) {
      settings.field = m_frame.settings->field;
    } else {
      note("The field of this moment cannot be used; the scenario has the default field.");
    }
    const auto models = sim::physicsModels();
    if (std::any_of(models.begin(), models.end(),
                    [&](const auto& model) { return model.name == m_frame.settings->physics; })) {
      settings.physics = m_frame.settings->physics;
      settings.noise = m_frame.settings->noise;
      settings.seed = m_frame.settings->seed;
      settings.tickRate = m_frame.settings->tickRate;
    }
    // Nothing of the frame may keep the match from starting.
    if (!sim::Simulation::create(settings)) {
      settings = m_options.base ? m_options.base->settings : sim::SimulationSettings{};
      note("The settings of this moment cannot be used; those of the scenario are.");
    }
  }

  void takeRobots() {
    for (const RobotFrame& robot : m_frame.robots) {
      if (m_out.scenario.robots.size() == sim::Simulation::maxRobots) {
        note("More than 64 robots; the rest is left out.");
        return;
      }
      takeRobot(robot);
    }
  }

  void takeRobot(const RobotFrame& robot) {
    ScenarioRobot out{robot.identity, robot.pose, m_options.behaviour, {}};
    if (m_options.base) {
      for (const ScenarioRobot& known : m_options.base->robots) {
        if (known.identity.id != robot.identity.id) continue;
        out.model = known.model;
        out.parameters = known.parameters;
        out.runtime = known.runtime;
      }
    }
    const std::string name = robot.identity.name();
    if (!robot.poseKnown()) {
      note(name + " never reported its pose, so it is left out.");
      return;
    }
    if (m_frame.truthKnown && believed()) {
      if (robot.belief) {
        out.pose = *robot.belief;
      } else {
        note(name + " is not localized, so its true pose is used.");
      }
    }
    if (!robot.behaviour.empty()) out.behaviour = robot.behaviour;
    const auto known = behaviours();
    if (out.behaviour != noBehaviour &&
        std::none_of(known.begin(), known.end(),
                     [&](const auto& behaviour) { return behaviour.name == out.behaviour; })) {
      note(name + " had the behaviour \"" + out.behaviour +
           "\", which this program does not have; " + "it plays " + m_options.behaviour + '.');
      out.behaviour = m_options.behaviour;
    }
    number(out, name);
    place(out, name);
    takeBoard(robot, out.identity.id, name);
    m_out.scenario.robots.push_back(std::move(out));
  }

  /// Its blackboard begins as it was.
  void takeBoard(const RobotFrame& robot, RobotId id, const std::string& name) {
    if (!robot.board.names) return;
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < robot.board.values.size(); ++i) {
      const std::string& variable = (*robot.board.names)[i];
      const Variable* known = m_options.catalog->find(variable);
      if (known == nullptr) ++unknown;
      if (known == nullptr || variable == refereeVariable) continue;
      double value = robot.board.values[i];
      if (known->type == VariableType::Float) {
        // A hole in a row is "not seen" on the blackboard.
        const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        value = static_cast<double>(std::bit_cast<float>(BoardColumns::boardWord(variable, word)));
      } else if (value != std::round(value)) {
        continue;
      }
      if (std::isfinite(value)) m_boards.push_back({id, variable, value, 0.0});
    }
    if (unknown == 0) return;
    note(name + " sent " + std::to_string(unknown) + (unknown == 1 ? " variable" : " variables") +
         " that the catalog of this match does not have.");
  }

  /// Numbers that are free and that a match has.
  void number(ScenarioRobot& robot, const std::string& name) {
    const auto taken = [&](auto&& same) {
      const auto& robots = m_out.scenario.robots;
      return std::any_of(robots.begin(), robots.end(), same);
    };
    int& id = robot.identity.id.value;
    const auto idTaken = [&](int value) {
      return taken([value](const auto& other) { return other.identity.id.value == value; });
    };
    if (id < 1 || id > highestRobotNumber || idTaken(id)) {
      id = 1;
      // Not a number that a later robot has by right.
      const auto& all = m_frame.robots;
      while (idTaken(id) || std::any_of(all.begin(), all.end(), [&](const auto& other) {
               return other.identity.id.value == id;
             })) {
        if (++id > highestRobotNumber) break;
      }
      if (id > highestRobotNumber) {
        for (id = 1; idTaken(id);) ++id;
      }
      note(name + " has the blackboard number " + std::to_string(id) + " here.");
    }
    int& shirt = robot.identity.number;
    const auto shirtTaken = [&](int value) {
      return taken([&](const auto& other) {
        return other.identity.team == robot.identity.team && other.identity.number == value;
      });
    };
    if (shirt < 1 || shirt > sim::highestShirtNumber || shirtTaken(shirt)) {
      for (shirt = 1; shirtTaken(shirt);) ++shirt;
      note("Two robots had the name " + name + "; one of them is now " + robot.identity.name() +
           ".");
    }
  }

  void place(ScenarioRobot& robot, const std::string& name) {
    const sim::FieldSpec& field = m_out.scenario.settings.field;
    if (!sim::isFinite(robot.pose)) {
      robot.pose = {{0.0, 0.0}, 0.0};
      note("The pose of " + name + " is unknown, so it is placed at the centre mark.");
    }
    const Point wanted = robot.pose.position;
    robot.pose.position = sim::insideWalls(field, wanted, radiusOf(robot));
    robot.pose.yaw = std::remainder(robot.pose.yaw, 2 * 3.141592653589793);
    if (robot.pose.position != wanted) {
      note(name + " was outside the walls and was moved inside.");
    }
  }

  double radiusOf(const ScenarioRobot& robot) const {
    return robot.model.radius > 0.0 ? robot.model.radius
                                    : m_out.scenario.settings.field.robotRadius;
  }

  void pushApart() {
    auto& robots = m_out.scenario.robots;
    const sim::FieldSpec& field = m_out.scenario.settings.field;
    std::set<std::size_t> moved;
    for (int round = 0; round < maxPushes; ++round) {
      bool free = true;
      for (std::size_t a = 0; a < robots.size(); ++a) {
        for (std::size_t b = a + 1; b < robots.size(); ++b) {
          Point& p = robots[a].pose.position;
          Point& q = robots[b].pose.position;
          const double between = distance(p, q);
          const double least = radiusOf(robots[a]) + radiusOf(robots[b]) + gap;
          if (between >= least - gap / 2) continue;
          free = false;
          // On the very same spot: apart in a direction that differs from pair to pair.
          const double angle = between > 1e-9 ? direction(p, q) : static_cast<double>(7 * a + b);
          const double push = (least - between) / 2;
          const Point step{push * std::cos(angle), push * std::sin(angle)};
          p = sim::insideWalls(field, {p.x - step.x, p.y - step.y}, radiusOf(robots[a]));
          q = sim::insideWalls(field, {q.x + step.x, q.y + step.y}, radiusOf(robots[b]));
          moved.insert({a, b});
        }
      }
      if (free) break;
    }
    if (moved.empty()) return;
    std::string names;
    for (const std::size_t i : moved) {
      names += (names.empty() ? "" : ", ") + robots[i].identity.name();
    }
    note("Overlapping robots were moved apart: " + names + '.');
  }

  struct Sighting {
    Point ball;
    double range = 0.0;
    std::string by;
  };

  std::vector<Sighting> sightings() const {
    std::vector<Sighting> out;
    for (const RobotFrame& robot : m_frame.robots) {
      if (!robot.ball || !sim::isFinite({robot.ball->place, 0.0})) continue;
      out.push_back({robot.ball->place, robot.ball->distance, robot.identity.name()});
    }
    return out;
  }

  void takeBall() {
    Scenario& scenario = m_out.scenario;
    const sim::FieldSpec& field = scenario.settings.field;
    scenario.ballVelocity = {};
    const bool perceived = !m_frame.ballKnown || m_options.ball == MomentOptions::Ball::Perceived;
    Point ball = m_frame.snapshot.ball;
    if (perceived) {
      ball = m_frame.ballKnown ? ball : Point{};
      perceiveBall(ball);
    } else {
      const Velocity& v = m_frame.snapshot.ballVelocity;
      if (std::isfinite(v.x) && std::isfinite(v.y)) {
        scenario.ballVelocity = {std::clamp(v.x, -sim::fastestBall, sim::fastestBall),
                                 std::clamp(v.y, -sim::fastestBall, sim::fastestBall)};
      }
    }
    if (!sim::isFinite({ball, 0.0})) ball = {};
    scenario.ball = sim::insideWalls(field, ball, field.ballRadius);
    if (scenario.ball != ball) note("The ball was outside the walls and was moved inside.");
  }

  /// Where most robots agree that it is.
  void perceiveBall(Point& ball) {
    const std::vector<Sighting> seen = sightings();
    if (seen.empty()) {
      note(m_frame.ballKnown ? "No robot sees the ball, so its true position is used."
                             : "No robot sees the ball, so it is placed on the centre mark.");
      return;
    }
    // A team that sees another ball than the other does not outvote it.
    const std::vector<TeamBall> balls = agreedBalls(m_frame.robots);
    const auto agreed = std::ranges::max_element(balls, {}, &TeamBall::agree);
    if (agreed != balls.end()) {
      ball = agreed->position;
      if (static_cast<std::size_t>(agreed->agree) == seen.size()) return;
      note("The robots disagree about the ball; the estimate of " + std::to_string(agreed->agree) +
           " of " + std::to_string(seen.size()) + " robots is used.");
      return;
    }
    // Far balls are seen less well.
    const auto nearest = std::min_element(
        seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.range < b.range; });
    ball = nearest->ball;
    note(seen.size() == 1 ? "Only " + nearest->by + " sees the ball."
                          : "No two robots agree about the ball; the estimate of " + nearest->by +
                                ", the nearest to it, is used.");
  }

  void takeGame() {
    Scenario& scenario = m_out.scenario;
    const sim::GameSnapshot& snapshot = m_frame.snapshot;
    scenario.writes = writesFrom(scenario.writes, snapshot.time, [&](RobotId id) {
      return std::any_of(scenario.robots.begin(), scenario.robots.end(),
                         [id](const auto& robot) { return robot.identity.id == id; });
    });
    scenario.game.reset();
    scenario.score = {};
    scenario.clock = 0.0;
    scenario.clockRunning = true;
    if (takeExactGame() || takePacket()) {
      // What the match tells its robots.
      std::erase_if(scenario.writes, [](const auto& w) { return w.variable == refereeVariable; });
      return;
    }
    scenario.settings.referee.reset();
    scenario.score = {std::max(0, snapshot.score.left), std::max(0, snapshot.score.right)};
    if (m_frame.truthKnown) {
      const double clock = snapshot.clock;
      scenario.clock = std::isfinite(clock) ? std::clamp(clock, 0.0, 1e6) : 0.0;
      scenario.clockRunning = snapshot.clockRunning;
    }
    const bool hasOrder = std::any_of(scenario.writes.begin(), scenario.writes.end(),
                                      [](const auto& w) { return w.variable == refereeVariable; });
    // Without orders of a referee the robots would never move.
    if (!hasOrder) {
      scenario.writes.insert(scenario.writes.begin(),
                             {{}, refereeVariable, static_cast<double>(refereePlay), 0.0});
    }
  }

  /// Returns the exact game of the moment, for the robots that are left.
  bool takeExactGame() {
    Scenario& scenario = m_out.scenario;
    if (!m_options.base || !m_options.base->game || !scenario.settings.referee) return false;
    sim::GameStart game = *m_options.base->game;
    const auto isGone = [&](RobotId id) {
      return std::none_of(scenario.robots.begin(), scenario.robots.end(),
                          [id](const auto& robot) { return robot.identity.id == id; });
    };
    std::erase_if(game.robots, [&](const auto& one) { return isGone(one.first); });
    if (game.touch && isGone(game.touch->robot)) game.touch.reset();
    if (game.setPlay && isGone(game.setPlay->kicker)) game.setPlay->kicker = {};
    scenario.game = std::move(game);
    return true;
  }

  bool takePacket() {
    if (!m_frame.game) return false;
    Scenario& scenario = m_out.scenario;
    if (!m_options.base || !m_options.base->settings.referee) scenario.settings.referee.reset();
    takeTeams();
    const RefereeReception& from = m_frame.reception;
    const auto& rules = m_frame.rules;
    const auto taken =
        link::takeGame(*m_frame.game, rules ? *rules : rulesOfPacket(from.version, from.size),
                       !rules && from.version == versionByColour, scenario);
    if (!taken) {
      note("The referee's game was left out: " + taken.error().text());
      return false;
    }
    note("The game continues from the referee's packet: " +
         std::string(labelOf(m_frame.game->state)) + " with " +
         std::to_string(m_frame.game->secondsLeft()) + " s left.");
    return true;
  }

  /// Sets the numbers in the GameController of the teams that have robots.
  void takeTeams() {
    auto& teams = m_out.scenario.settings.teams;
    if (!teams.empty()) return;
    for (const RobotFrame& robot : m_frame.robots) {
      const auto place = static_cast<std::size_t>(robot.key.team);
      const TeamColor colour = robot.identity.team;
      const bool known = std::any_of(teams.begin(), teams.end(),
                                     [colour](const auto& team) { return team.colour == colour; });
      if (known || place >= m_frame.teams.size() || m_frame.teams[place].number == 0) continue;
      teams.push_back({colour, m_frame.teams[place].number, m_frame.teams[place].name});
    }
    if (teams.size() > 2) teams.clear();
  }

  static constexpr const char* refereeVariable = "COM_REFEREE";
  const MatchFrame& m_frame;
  const MomentOptions& m_options;
  MomentScenario m_out;
  std::vector<BlackboardWrite> m_boards;
};

}  // namespace

MomentScenario scenarioFromMoment(const MatchFrame& frame, const MomentOptions& options) {
  return Maker(frame, options).make();
}

}  // namespace pitchboard::link
