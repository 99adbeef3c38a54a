// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/match_sampler.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <base/angles.h>
#include <base/lined_json.h>
#include <robotlink/frame/teams.h>
#include <robotlink/match/simulated_match.h>
#include <simcore/world/action_codes.h>
#include <simcore/world/published_frame.h>
#include <telemetry/series/series_types.h>

#include "game_columns.h"

namespace pitchboard::link {
namespace {

using telemetry::ColumnInfo;
using telemetry::ColumnKind;
using telemetry::ColumnType;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double centimetres = 100.0;

// What a session keeps of values that nothing is entered again from (that is done from checkpoints,
// which keep every bit), or that follow from columns that are kept in full.
constexpr double derived = 1.0 / 256;          // 0.04 mm, 0.004°
constexpr double speed_mps = 1.0 / (1 << 17);  // 8 µm/s
constexpr double place_m = 1.0 / (1 << 17);    // 8 µm
constexpr double angle_deg = 1.0 / (1 << 12);  // 0.0002°
constexpr double microseconds = 1.0 / 8;

/// What the columns of a robot are computed from.
struct Robot {
  const sim::Snapshot& snapshot;
  const sim::RobotSnapshot& truth;
  std::optional<Pose> belief;
  double trueBallDistance = 0.0, trueBallBearing = 0.0;  // m, rad, left positive
  bool ballSeen = false;
  double seenBallDistance = 0.0, seenBallBearing = 0.0;
};

struct RobotColumn {
  const char *name, *unit, *category;
  double (*read)(const Robot&);
  ColumnKind kind = ColumnKind::Number;
  double resolution = 0.0;
};

double beliefError(const Robot& r, double (*error)(const Pose& belief, const Pose& truth)) {
  return r.belief ? error(*r.belief, r.truth.pose) : unknown;
}

constexpr const char *truth = "Truth", *belief = "Belief", *errors = "Belief error";

const std::array robotColumns{
    RobotColumn{"TRUE_X", "m", truth, [](const Robot& r) { return r.truth.pose.position.x; }},
    RobotColumn{"TRUE_Y", "m", truth, [](const Robot& r) { return r.truth.pose.position.y; }},
    RobotColumn{"TRUE_YAW", "°", truth,
                [](const Robot& r) { return degreesFromRadians(r.truth.pose.yaw); }},
    RobotColumn{"HEAD_YAW", "°", truth,
                [](const Robot& r) { return degreesFromRadians(r.truth.headYaw); },
                ColumnKind::Number, angle_deg},
    RobotColumn{"VX", "m/s", truth, [](const Robot& r) { return r.truth.velocity.x; },
                ColumnKind::Number, speed_mps},
    RobotColumn{"VY", "m/s", truth, [](const Robot& r) { return r.truth.velocity.y; },
                ColumnKind::Number, speed_mps},
    RobotColumn{"ACTION", "", truth, [](const Robot& r) { return double(r.truth.action); },
                ColumnKind::Enumeration},
    RobotColumn{"FALLEN", "", truth, [](const Robot& r) { return r.truth.fallen ? 1.0 : 0.0; },
                ColumnKind::Flag},
    RobotColumn{"DISTANCE_WALKED", "m", truth,
                [](const Robot& r) { return r.truth.statistics.distanceWalked; }},
    RobotColumn{"KICKS", "", truth,
                [](const Robot& r) { return double(r.truth.statistics.kicks); }},
    RobotColumn{"FALLS", "", truth,
                [](const Robot& r) { return double(r.truth.statistics.falls); }},
    RobotColumn{"UNKNOWN_ACTIONS", "", truth,
                [](const Robot& r) { return double(r.truth.statistics.unknownActions); }},
    RobotColumn{"LAST_UNKNOWN_ACTION", "", truth,
                [](const Robot& r) { return double(r.truth.statistics.lastUnknownAction); }},
    RobotColumn{"TRUE_BALL_DIST", "cm", truth,
                [](const Robot& r) { return r.trueBallDistance * centimetres; }, ColumnKind::Number,
                derived},
    RobotColumn{"TRUE_BALL_ANGLE", "°", truth,
                [](const Robot& r) { return degreesFromRadians(r.trueBallBearing); },
                ColumnKind::Number, derived},

    RobotColumn{"BELIEF_X", "m", belief,
                [](const Robot& r) { return r.belief ? r.belief->position.x : unknown; },
                ColumnKind::Number, place_m},
    RobotColumn{"BELIEF_Y", "m", belief,
                [](const Robot& r) { return r.belief ? r.belief->position.y : unknown; },
                ColumnKind::Number, place_m},
    RobotColumn{
        "BELIEF_YAW", "°", belief,
        [](const Robot& r) { return r.belief ? degreesFromRadians(r.belief->yaw) : unknown; },
        ColumnKind::Number, angle_deg},

    RobotColumn{"BELIEF_ERROR", "cm", errors,
                [](const Robot& r) {
                  return beliefError(r, [](const Pose& b, const Pose& t) {
                    return centimetres * distance(b.position, t.position);
                  });
                },
                ColumnKind::Number, derived},
    RobotColumn{"BELIEF_ERROR_YAW", "°", errors,
                [](const Robot& r) {
                  return beliefError(r, [](const Pose& b, const Pose& t) {
                    return degreesFromRadians(wrapToPi(b.yaw - t.yaw));
                  });
                },
                ColumnKind::Number, derived},
    // Between the ball as seen from the true pose and the true ball: vision's own error.
    RobotColumn{"BALL_ERROR", "cm", errors,
                [](const Robot& r) {
                  if (!r.ballSeen) return unknown;
                  const double across = r.seenBallBearing - r.trueBallBearing;
                  return centimetres *
                         std::hypot(r.seenBallDistance * std::cos(across) - r.trueBallDistance,
                                    r.seenBallDistance * std::sin(across));
                },
                ColumnKind::Number, derived},
    RobotColumn{"BALL_DIST_ERROR", "cm", errors,
                [](const Robot& r) {
                  return r.ballSeen ? centimetres * (r.seenBallDistance - r.trueBallDistance)
                                    : unknown;
                },
                ColumnKind::Number, derived},
    RobotColumn{"BALL_ANGLE_ERROR", "°", errors,
                [](const Robot& r) {
                  return r.ballSeen
                             ? degreesFromRadians(wrapToPi(r.seenBallBearing - r.trueBallBearing))
                             : unknown;
                },
                ColumnKind::Number, derived}};

struct MatchColumn {
  const char *name, *unit, *category;
  double (*read)(const sim::Snapshot&);
  ColumnKind kind = ColumnKind::Number;
  double resolution = 0.0;
};

constexpr const char *ofTheMatch = "Match", *ofTiming = "Timing";

const std::array theMatchColumns{
    MatchColumn{"TICK", "", ofTiming, [](const sim::Snapshot& s) { return double(s.tick); }},
    MatchColumn{"BALL_X", "m", truth, [](const sim::Snapshot& s) { return s.ball.x; }},
    MatchColumn{"BALL_Y", "m", truth, [](const sim::Snapshot& s) { return s.ball.y; }},
    MatchColumn{"BALL_VX", "m/s", truth, [](const sim::Snapshot& s) { return s.ballVelocity.x; },
                ColumnKind::Number, speed_mps},
    MatchColumn{"BALL_VY", "m/s", truth, [](const sim::Snapshot& s) { return s.ballVelocity.y; },
                ColumnKind::Number, speed_mps},
    MatchColumn{"CLOCK", "s", ofTheMatch, [](const sim::Snapshot& s) { return s.clock; }},
    MatchColumn{"CLOCK_RUNNING", "", ofTheMatch,
                [](const sim::Snapshot& s) { return s.clockRunning ? 1.0 : 0.0; },
                ColumnKind::Flag},
    MatchColumn{"SCORE_LEFT", "", ofTheMatch,
                [](const sim::Snapshot& s) { return double(s.score.left); }},
    MatchColumn{"SCORE_RIGHT", "", ofTheMatch,
                [](const sim::Snapshot& s) { return double(s.score.right); }}};

template <class Column>
ColumnInfo columnInfo(const Column& column) {
  return {column.name, ColumnType::Float64, column.unit, column.category, column.kind,
          {},          column.resolution};
}

std::vector<ColumnInfo> truthColumns() {
  std::vector<ColumnInfo> out;
  for (const RobotColumn& column : robotColumns) {
    out.push_back(columnInfo(column));
    if (column.kind == ColumnKind::Enumeration) out.back().labels = actionLabels();
  }
  const auto ofGame = playerColumns();
  out.insert(out.end(), ofGame.begin(), ofGame.end());
  return out;
}

/// In the order of truthColumns(); NaN where there is nothing to say (ball not seen, no belief
/// yet).
void readTruth(const SimulatedMatch& match, const sim::Snapshot& snapshot,
               const sim::RobotSnapshot& robot, const Blackboard& board, std::span<double> out) {
  const RobotVariables& v = match.variables();
  Robot r{snapshot, robot, {}};
  const int x = readOr(board, v.localizationX), y = readOr(board, v.localizationY),
            theta = readOr(board, v.localizationTheta);
  // All zero: nothing has been written yet (the corner of the field, exactly).
  if (x != 0 || y != 0 || theta != 0 || readOr(board, v.localizationBelief) != 0.0F) {
    r.belief = sim::published_frame::studioFromLocalization(
        match.simulation().state().settings.field, {double(x), double(y), double(theta)});
  }
  r.trueBallDistance = distance(snapshot.ball, robot.pose.position);
  r.trueBallBearing = wrapToPi(direction(robot.pose.position, snapshot.ball) - robot.pose.yaw);
  r.ballSeen = isPresent(v.visionBallDist) && isPresent(v.visionPanDeg) &&
               readOr(board, v.visionLost, 1) == 0 && board.read(v.visionBallDist) > 0.0F;
  if (r.ballSeen) {
    r.seenBallDistance = static_cast<double>(board.read(v.visionBallDist)) / centimetres;
    r.seenBallBearing = radiansFromDegrees(static_cast<double>(board.read(v.visionPanDeg)));
  }
  for (std::size_t i = 0; i < robotColumns.size(); ++i) out[i] = robotColumns[i].read(r);
  readPlayer(match.simulation().state(), robot.identity, out.subspan(robotColumns.size()));
}

std::vector<ColumnInfo> matchColumns() {
  std::vector<ColumnInfo> out;
  for (const MatchColumn& column : theMatchColumns) {
    out.push_back(columnInfo(column));
  }
  out.push_back(
      {"TICK_TIME", ColumnType::Float64, "µs", ofTiming, ColumnKind::Number, {}, microseconds});
  const auto ofGame = gameColumns();
  out.insert(out.end(), ofGame.begin(), ofGame.end());
  return out;
}

void readMatch(const sim::WorldState& world, const sim::Snapshot& snapshot, double tickTime_us,
               std::span<double> out) {
  for (std::size_t i = 0; i < theMatchColumns.size(); ++i)
    out[i] = theMatchColumns[i].read(snapshot);
  out[theMatchColumns.size()] = tickTime_us;
  readGame(world, out.subspan(theMatchColumns.size() + 1));
}

constexpr std::size_t publishedRobots = 11;  // VISION_RBT01 to VISION_RBT11
constexpr std::string_view sightOfRobots = "VISION_RBT", ofAdvisor = "ADVISOR_";

/// Returns which parts of the map's extension are in use.
MatchSampler::Extension extensionOf(const SimulatedMatch& match) {
  const auto& slots = match.robots().all();
  const bool used = std::ranges::any_of(slots, [](const auto& slot) { return slot->extended; });
  return {used, used && slots.size() > publishedRobots, !match.scenario().advisors.empty()};
}

bool isUsed(const std::string& name, const MatchSampler::Extension& extension) {
  if (name.starts_with(ofAdvisor)) return extension.advised;
  if (name.starts_with(sightOfRobots)) return extension.manyRobots;
  // What a match and a team program tell each other is no value of the robot.
  return extension.used && name != "MATCH_CYCLE";
}

/// The variables of the map, and those of its extension that are in use: without them nobody could
/// tell from a recording what flowed into a process.
std::vector<Variable> sampledVariables(const VariableCatalog& catalog,
                                       const MatchSampler::Extension& extension) {
  const auto own = catalog.variables();
  std::vector<Variable> out(own.begin(), own.end());
  const VariableCatalog all = catalog.withExtension();
  for (const Variable& more : all.variables()) {
    if (!catalog.find(more.name) && isUsed(more.name, extension)) out.push_back(more);
  }
  return out;
}

}  // namespace

MatchSampler::MatchSampler(std::shared_ptr<telemetry::RowSink> sink, MatchSamplerOptions options) {
  setEveryNth(options.everyNth);
  if (sink) m_outlets.push_back({std::move(sink), {}});
}

MatchSampler::~MatchSampler() = default;

void MatchSampler::ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) {
  const std::uint64_t tick = match.simulation().state().tick;
  // A moment without a tick (the first one, a change by hand) is always shown.
  const bool due = tickTime.count() == 0 || tick % std::uint64_t(m_options.everyNth) == 0;
  if (m_outlets.empty() || !due) return;
  look(match);
  sampleInto(m_outlets, match, tickTime);
}

void MatchSampler::add(std::shared_ptr<telemetry::RowSink> sink, const SimulatedMatch& match) {
  look(match);
  Outlet& outlet = m_outlets.emplace_back(Outlet{std::move(sink), {}});
  registerGroups(outlet);
  sampleInto({&outlet, 1}, match, {});
}

void MatchSampler::remove(const std::shared_ptr<telemetry::RowSink>& sink) {
  std::erase_if(m_outlets, [&](const Outlet& outlet) { return outlet.sink == sink; });
}

void MatchSampler::look(const SimulatedMatch& match) {
  match.simulation().snapshot(m_snapshot);
  if (sameRobots(match)) return;
  takeRobots(match);
  for (Outlet& outlet : m_outlets) registerGroups(outlet);
}

void MatchSampler::registerGroups(Outlet& outlet) const {
  outlet.groups.clear();
  for (const telemetry::GroupInfo& group : m_groups) {
    outlet.groups.push_back(outlet.sink->addGroup(group));
  }
}

void MatchSampler::sampleInto(std::span<const Outlet> outlets, const SimulatedMatch& match,
                              std::chrono::nanoseconds tickTime) {
  const auto append = [&](std::size_t group, const telemetry::RowView& row) {
    for (const Outlet& outlet : outlets) outlet.sink->append(outlet.groups[group], row);
  };
  readMatch(match.simulation().state(), m_snapshot,
            std::chrono::duration<double, std::micro>(tickTime).count(), m_matchValues);
  append(0, {m_snapshot.time, {}, m_matchValues});
  for (std::size_t i = 0; i < m_sampled.size(); ++i) {
    const sim::RobotSnapshot& robot = m_snapshot.robots[i];
    const Blackboard* board = match.blackboard(robot.identity.id);
    if (!board) continue;
    m_board->read(*board, m_words);
    readTruth(match, m_snapshot, robot, *board, m_truth);
    append(i + 1, {m_snapshot.time, m_words, m_truth});
  }
}

bool MatchSampler::sameRobots(const SimulatedMatch& match) const {
  if (m_catalog != &match.catalog() || m_extension != extensionOf(match)) return false;
  return std::ranges::equal(
      m_sampled, m_snapshot.robots, [&](const SampledRobot& sampled, const auto& robot) {
        const RobotSlot* slot = match.robots().find(robot.identity.id);
        return sampled.identity == robot.identity && slot && sampled.key == slot->board.key() &&
               sampled.behaviour == slot->behaviour && sampled.programs == slot->programs &&
               sampled.radius == robot.radius && sampled.fieldOfView == robot.fieldOfView &&
               sampled.visionRange == robot.visionRange;
      });
}

void MatchSampler::takeRobots(const SimulatedMatch& match) {
  const Extension extension = extensionOf(match);
  if (m_catalog != &match.catalog() || m_extension != extension) {
    m_catalog = &match.catalog();
    m_extension = extension;
    m_board = std::make_unique<BoardColumns>(sampledVariables(match.catalog(), extension));
  }
  const sim::SimulationSettings& settings = match.simulation().state().settings;
  telemetry::GroupInfo group{matchGroup, matchColumns(), {}};
  group.match = telemetry::MatchFacts{settings.physics, settings.seed, settings.tickRate};
  m_matchValues.resize(group.columns.size());
  m_groups.clear();
  m_groups.push_back(std::move(group));

  auto truth = truthColumns();
  // A team's own variable keeps its name.
  for (telemetry::ColumnInfo& column : truth) {
    while (std::ranges::find(m_board->columns(), column.name, &telemetry::ColumnInfo::name) !=
           m_board->columns().end()) {
      column.name.insert(0, "TRUTH_");
    }
  }
  m_words.resize(m_board->size());
  m_truth.resize(truth.size());
  m_sampled.clear();
  Teams teams;
  fillTeams(settings.teams, teams);
  for (const sim::RobotSnapshot& robot : m_snapshot.robots) {
    const sim::RobotIdentity& identity = robot.identity;
    const RobotSlot& slot = *match.robots().find(identity.id);
    SampledRobot sampled{identity,     slot.board.key(),  slot.behaviour,   slot.programs,
                         robot.radius, robot.fieldOfView, robot.visionRange};
    telemetry::GroupInfo info{groupName(identity), m_board->columns(), {}};
    info.columns.insert(info.columns.end(), truth.begin(), truth.end());
    const sim::RobotModel& model = *match.robots().model(identity.id);
    const RobotKey key = keyOf(identity);
    telemetry::RobotFacts& facts = info.robot.emplace();
    facts.uid = uidOf(identity.id);
    facts.slot = identity.id.value;
    facts.team = identity.team;
    facts.number = identity.number;
    facts.boardKey = sampled.key;
    facts.imuStartsAt180 = identity.imuStartsAt180;
    facts.behaviour = sampled.behaviour;
    facts.programs = sampled.programs;
    facts.radius_m = robot.radius;
    facts.fieldOfView_deg = degreesFromRadians(robot.fieldOfView);
    facts.visionRange_m = robot.visionRange;
    facts.battery =
        telemetry::BatteryVolts{model.batteryFull, model.batteryLow, model.batteryEmpty};
    facts.order = orderOf(key, teams);
    facts.teamName = teams[static_cast<std::size_t>(key.team)].name;
    m_groups.push_back(std::move(info));
    m_sampled.push_back(std::move(sampled));
  }
}

std::string MatchSampler::groupName(const sim::RobotIdentity& robot) const {
  const std::string name = robot.name();
  // Two robots of a team may have one number by mistake; their rows must not mix.
  const bool taken = std::ranges::any_of(m_sampled, [&](const SampledRobot& sampled) {
    return sampled.identity.team == robot.team && sampled.identity.number == robot.number;
  });
  return taken ? name + " (" + std::to_string(robot.id.value) + ")" : name;
}

}  // namespace pitchboard::link
