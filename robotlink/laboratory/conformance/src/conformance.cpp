// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include <base/try.h>
#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/cognition/naive_decision.h>
#include <robotlink/conformance/conformance.h>
#include <robotlink/match/blackboard_bridge.h>
#include <simcore/simulation/simulation.h>

#include "trace_file.h"

namespace pitchboard::link {
namespace {

constexpr double distanceToKickInTraces = 40.0;

/// The published world of one trace: simulation, blackboards, and what was seen between the update
/// of all robots and ball vision.
class TraceWorld {
 public:
  static Result<std::unique_ptr<TraceWorld>> make(const Trace& trace) {
    sim::SimulationSettings settings;
    settings.physics = "published";
    settings.afterGoal = sim::AfterGoal::StopClock;
    auto simulation = TRY(sim::Simulation::create(settings));
    std::unique_ptr<TraceWorld> world(new TraceWorld(std::move(simulation)));
    TRY(world->place(trace));
    return world;
  }

  const sim::PublishedState& published() const {
    return std::get<sim::PublishedState>(m_simulation.state().physics);
  }
  const sim::WorldState& state() const { return m_simulation.state(); }
  const Blackboard& board(std::size_t robot) const { return m_boards[robot]; }
  float panAfterUpdate(std::size_t robot) const { return m_panAfterUpdate[robot]; }

  Result<void> apply(const TraceOperation& operation) {
    return std::visit([this](const auto& op) { return carryOut(op); }, operation);
  }

  void decide() {
    for (Blackboard& board : m_boards) {
      const NaiveOutput output =
          naiveRule(board.read(m_variables.visionLost), board.read(m_variables.visionPanDeg),
                    board.read(m_variables.visionBallDist), distanceToKickInTraces);
      if (output.searchOn) board.write(m_variables.decisionSearchOn, 1);
      if (output.actionB) board.write(m_variables.decisionActionB, *output.actionB);
      board.write(m_variables.decisionActionA, output.actionA);
    }
  }

  void step() {
    for (std::size_t i = 0; i < m_boards.size(); ++i) m_commands[i] = m_bridge.read(m_boards[i]);
    m_simulation.step(m_commands, m_percepts);
    for (std::size_t i = 0; i < m_boards.size(); ++i) {
      m_bridge.publishBody(m_percepts[i], m_boards[i]);
      m_panAfterUpdate[i] = m_boards[i].read(m_variables.visionPanDeg);
      m_bridge.publishSight(m_percepts[i], m_boards[i]);
    }
  }

 private:
  explicit TraceWorld(sim::Simulation simulation) : m_simulation(std::move(simulation)) {}

  Result<void> place(const Trace& trace) {
    m_simulation.setClockRunning(false);
    for (std::size_t i = 0; i < trace.robots.size(); ++i) {
      const TraceRobot& robot = trace.robots[i];
      const int number = static_cast<int>(i) + 1;
      auto added = m_simulation.addRobot(
          {RobotId{number}, robot.team, number, robot.imuStartsAt180}, Pose{});
      if (!added) return added;
      m_boards.push_back(Blackboard::onHeap());
      m_boards.back().write(m_variables.decisionSearchOn, 1);
      for (const auto& [name, value] : robot.initialInts) {
        TRY(carryOut(WriteInt{i, name, value}));
      }
      (void)carryOut(PlaceTraceRobot{i, robot.x, robot.y, robot.rotate, robot.rotate});
    }
    edit().ball = {trace.ballX, trace.ballY, 0.0, 0.0, trace.ballFriction};
    m_commands.resize(m_boards.size());
    m_percepts.resize(m_boards.size());
    m_panAfterUpdate.resize(m_boards.size());
    return {};
  }

  sim::PublishedState& edit() {
    return std::get<sim::PublishedState>(m_simulation.editState().physics);
  }

  Result<void> carryOut(const WriteInt& op) {
    const auto variable = VariableCatalog::published().intVar(op.variable);
    if (!variable) return unknown(op.variable);
    m_boards[op.robot].write(*variable, op.value);
    return {};
  }
  Result<void> carryOut(const WriteFloat& op) {
    const auto variable = VariableCatalog::published().floatVar(op.variable);
    if (!variable) return unknown(op.variable);
    m_boards[op.robot].write(*variable, static_cast<float>(op.value));
    return {};
  }
  Result<void> carryOut(const PlaceTraceRobot& op) {
    sim::PublishedRobot& robot = edit().robots[op.robot];
    robot.x = op.x;
    robot.y = op.y;
    robot.rotate = op.rotate;
    robot.view = op.view;
    return {};
  }
  Result<void> carryOut(const NewBall& op) {
    edit().ball = {op.x, op.y, 0.0, 0.0, 0.95};
    return {};
  }
  Result<void> carryOut(const MoveBall& op) {
    const double radians = op.angle * (std::numbers::pi / 180.0);
    edit().ball.vx = op.speed * std::cos(radians);
    edit().ball.vy = -op.speed * std::sin(radians);
    return {};
  }
  Result<void> carryOut(const StopGame& op) {
    m_simulation.setClockRunning(!op.stopped);
    return {};
  }

  static Result<void> unknown(const std::string& variable) {
    return failure(ErrorCode::NotFound,
                   "The published blackboard has no variable \"" + variable + "\" of that type.");
  }

  sim::Simulation m_simulation;
  RobotVariables m_variables{VariableCatalog::published()};
  BlackboardBridge m_bridge{m_variables};
  std::vector<Blackboard> m_boards;
  std::vector<sim::RobotCommand> m_commands;
  std::vector<sim::Percepts> m_percepts;
  std::vector<float> m_panAfterUpdate;
};

/// How one column of the recording is computed and compared.
struct Column {
  std::string name;
  std::function<double(const TraceWorld&)> value;
  bool exact = true;  ///< ints and float32 must be identical, signs of zero included
};

Result<Column> robotColumn(const std::string& column, const std::string& name, std::size_t robot) {
  using Published = sim::PublishedRobot;
  struct Member {
    const char* name;
    double (*read)(const Published&);
    bool exact;
  };
  static constexpr std::array<Member, 7> members{{
      {"x", [](const Published& r) { return r.x; }, false},
      {"y", [](const Published& r) { return r.y; }, false},
      {"rotate", [](const Published& r) { return r.rotate; }, false},
      {"view_rot", [](const Published& r) { return r.view; }, false},
      {"action_flag", [](const Published& r) { return double(r.action); }, true},
      {"pan_right", [](const Published& r) { return r.panRight ? 1.0 : 0.0; }, true},
      {"pan_left", [](const Published& r) { return r.panRight ? 0.0 : 1.0; }, true},
  }};
  for (const Member& member : members) {
    if (name != member.name) continue;
    return Column{column,
                  [robot, read = member.read](const TraceWorld& w) {
                    return read(w.published().robots[robot]);
                  },
                  member.exact};
  }
  if (name == "VISION_PAN_DEG_after_update") {
    return Column{column, [robot](const TraceWorld& w) { return double(w.panAfterUpdate(robot)); }};
  }
  const VariableCatalog& catalog = VariableCatalog::published();
  if (const auto variable = catalog.intVar(name)) {
    return Column{column, [robot, v = *variable](const TraceWorld& w) {
                    return double(w.board(robot).read(v));
                  }};
  }
  if (const auto variable = catalog.floatVar(name)) {
    return Column{column, [robot, v = *variable](const TraceWorld& w) {
                    return double(w.board(robot).read(v));
                  }};
  }
  return failure(ErrorCode::ParseError, "The column \"" + column + "\" is not known.");
}

Result<Column> columnOf(const std::string& name, std::size_t robots) {
  static const std::array<Column, 8> common{{
      {"frame", [](const TraceWorld& w) { return double(w.state().tick); }},
      {"ball_x", [](const TraceWorld& w) { return w.published().ball.x; }, false},
      {"ball_y", [](const TraceWorld& w) { return w.published().ball.y; }, false},
      {"ball_speed_x", [](const TraceWorld& w) { return w.published().ball.vx; }, false},
      {"ball_speed_y", [](const TraceWorld& w) { return w.published().ball.vy; }, false},
      {"GameStop", [](const TraceWorld& w) { return w.state().clockRunning ? 0.0 : 1.0; }},
      {"FriendGoals", [](const TraceWorld& w) { return double(w.state().score.left); }},
      {"EnemyGoals", [](const TraceWorld& w) { return double(w.state().score.right); }},
  }};
  for (const Column& column : common) {
    if (column.name == name) return column;
  }
  for (std::size_t robot = 0; robot < robots; ++robot) {
    const std::string prefix = "r" + std::to_string(robot + 1) + "_";
    if (name.starts_with(prefix)) return robotColumn(name, name.substr(prefix.size()), robot);
  }
  return failure(ErrorCode::ParseError, "The column \"" + name + "\" is not known.");
}

class Comparison {
 public:
  Comparison(const Trace& trace, std::vector<Column> columns)
      : m_trace(trace), m_columns(std::move(columns)) {
    m_report.name = trace.name;
  }

  void compareRow(const TraceWorld& world, std::size_t row) {
    ++m_report.rows;
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      compare(m_columns[i], row, m_trace.rows[row][i], m_columns[i].value(world));
    }
  }

  const ConformanceReport& report() const { return m_report; }

 private:
  void compare(const Column& column, std::size_t row, double recorded, double computed) {
    ++m_report.values;
    if (std::bit_cast<std::uint64_t>(recorded) == std::bit_cast<std::uint64_t>(computed)) return;
    const double deviation = std::abs(recorded - computed);
    const std::string where = "frame " + std::to_string(row) + ", " + column.name;
    if (!column.exact && deviation > m_report.largestDeviation) {
      m_report.largestDeviation = deviation;
      m_report.largestWhere = where;
    }
    if (!column.exact && deviation <= conformanceTolerance) return;
    if (m_report.differences++ == 0) {
      char values[96];
      std::snprintf(values, sizeof values, ": %.17g recorded, %.17g computed", recorded, computed);
      m_report.firstDifference = where + values;
    }
  }

  const Trace& m_trace;
  std::vector<Column> m_columns;
  ConformanceReport m_report;
};

}  // namespace

Result<ConformanceReport> runConformance(const std::string& jsonPath) {
  auto trace = readTrace(jsonPath);
  if (!trace) return tl::unexpected(trace.error());
  const auto inFile = [&jsonPath](Error error) {
    if (error.context.empty()) error.context = jsonPath;
    return tl::unexpected(error);
  };
  auto world = TraceWorld::make(*trace);
  if (!world) return inFile(world.error());
  std::vector<Column> columns;
  for (const std::string& name : trace->columns) {
    auto column = columnOf(name, trace->robots.size());
    if (!column) return inFile(column.error());
    columns.push_back(std::move(*column));
  }

  Comparison comparison(*trace, std::move(columns));
  comparison.compareRow(**world, 0);
  std::size_t next = 0;
  for (int frame = 1; frame <= trace->frames; ++frame) {
    for (; next < trace->schedule.size() && trace->schedule[next].frame == frame; ++next) {
      if (auto done = (*world)->apply(trace->schedule[next].operation); !done) {
        return inFile(done.error());
      }
    }
    if (trace->naiveEvery > 0 && frame % trace->naiveEvery == 0) (*world)->decide();
    (*world)->step();
    // After the frame in which the published program died there is nothing to compare with, but
    // ours must live on.
    if (const auto row = static_cast<std::size_t>(frame); row < trace->rows.size()) {
      comparison.compareRow(**world, row);
    }
  }
  return comparison.report();
}

}  // namespace pitchboard::link
