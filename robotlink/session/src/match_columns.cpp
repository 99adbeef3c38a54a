// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_columns.h"

#include <array>
#include <cmath>
#include <limits>

#include <base/angles.h>
#include <simcore/world/action_codes.h>
#include <simcore/world/published_frame.h>

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

}  // namespace

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

}  // namespace pitchboard::link
