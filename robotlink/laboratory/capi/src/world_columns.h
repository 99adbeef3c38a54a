// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rows that can be read of a world: each number stands here once, with its name, its words and
// where it comes from. A visitor gets (name, words, value) in the order of the columns. Programs
// know columns by their place: a new one is added at the end of its function, and to
// tests/data/world_columns.txt. Units are those of the values: percepts as on the blackboard, the
// truth in metres, seconds and radians. Any thread.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <simcore/world/robot_io.h>
#include <simcore/world/snapshot.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link::columns {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

inline double number(double value) {
  return value;
}
inline double number(int value) {
  return static_cast<double>(value);
}
inline double number(std::uint32_t value) {
  return static_cast<double>(value);
}
inline double number(std::uint64_t value) {
  return static_cast<double>(value);
}
inline double number(bool value) {
  return value ? 1.0 : 0.0;
}
template <class T>
double number(const std::optional<T>& value) {
  return value ? number(*value) : nothing;
}

/// Of an array that may be absent as a whole.
template <std::size_t N>
double entry(const std::optional<std::array<double, N>>& values, std::size_t i) {
  return values ? (*values)[i] : nothing;
}

struct SeenNames {
  std::string_view distance, angle;
};
inline constexpr std::array<SeenNames, sim::Percepts::maxSeenRobots> seenNames{{
    {"robot_01_distance_cm", "robot_01_angle_deg"}, {"robot_02_distance_cm", "robot_02_angle_deg"},
    {"robot_03_distance_cm", "robot_03_angle_deg"}, {"robot_04_distance_cm", "robot_04_angle_deg"},
    {"robot_05_distance_cm", "robot_05_angle_deg"}, {"robot_06_distance_cm", "robot_06_angle_deg"},
    {"robot_07_distance_cm", "robot_07_angle_deg"}, {"robot_08_distance_cm", "robot_08_angle_deg"},
    {"robot_09_distance_cm", "robot_09_angle_deg"}, {"robot_10_distance_cm", "robot_10_angle_deg"},
    {"robot_11_distance_cm", "robot_11_angle_deg"}, {"robot_12_distance_cm", "robot_12_angle_deg"},
    {"robot_13_distance_cm", "robot_13_angle_deg"}, {"robot_14_distance_cm", "robot_14_angle_deg"},
    {"robot_15_distance_cm", "robot_15_angle_deg"}, {"robot_16_distance_cm", "robot_16_angle_deg"},
    {"robot_17_distance_cm", "robot_17_angle_deg"}, {"robot_18_distance_cm", "robot_18_angle_deg"},
    {"robot_19_distance_cm", "robot_19_angle_deg"}, {"robot_20_distance_cm", "robot_20_angle_deg"},
    {"robot_21_distance_cm", "robot_21_angle_deg"}, {"robot_22_distance_cm", "robot_22_angle_deg"},
}};
static_assert(!seenNames.back().distance.empty(), "every robot that can be seen has its names");

/// `robots`: how many of the robots that can be seen have their columns.
template <class Visit>
void visitPercepts(const sim::Percepts& p, Visit&& visit, std::size_t robots = seenNames.size()) {
  const auto& control = p.control;
  visit("control_action", "code that control carries out (CONTROL_ACTION)", control.action);
  visit("control_moving", "1 while the body moves (CONTROL_MOVING)", control.moving);
  visit("finished_action", "code that was carried out in this tick", control.finishedAction);
  const auto& imu = p.imu;
  visit("imu_yaw", "rad from where the IMU was reset (IMU_EULER_Z)", imu.eulerZ);
  visit("imu_roll", "rad (IMU_EULER_X)", entry(imu.eulerXY, 0));
  visit("imu_pitch", "rad (IMU_EULER_Y)", entry(imu.eulerXY, 1));
  visit("gyro_x", "rad/s (IMU_GYRO_X)", entry(imu.gyro, 0));
  visit("gyro_y", "rad/s (IMU_GYRO_Y)", entry(imu.gyro, 1));
  visit("gyro_z", "rad/s (IMU_GYRO_Z)", entry(imu.gyro, 2));
  visit("accel_x", "g, forward (IMU_ACCEL_X)", entry(imu.accel, 0));
  visit("accel_y", "g, to the left (IMU_ACCEL_Y)", entry(imu.accel, 1));
  visit("accel_z", "g, upward (IMU_ACCEL_Z)", entry(imu.accel, 2));
  visit("imu_fallen", "1 while the robot lies (IMU_STATE)", imu.state);
  visit("imu_reset_done", "1 when the IMU was reset in this tick", imu.resetDone);
  const auto& marks = p.landmarks;
  visit("landmark_ball_cm", "cm to the ball seen as a landmark, -1 = not seen (VISION_TILT_DEG)",
        marks.ballTiltDeg);
  visit("landmark_ball_deg", "degrees to the left of the ball seen as a landmark (VISION_PAN_DEG)",
        marks.ballPanDeg);
  visit("corner_blue_deg", "degrees to the left of the corner top left, -999 = not seen",
        entry(marks.bearingsDeg, 0));
  visit("corner_red_deg", "the same, top right", entry(marks.bearingsDeg, 1));
  visit("corner_yellow_deg", "the same, bottom left", entry(marks.bearingsDeg, 2));
  visit("corner_purple_deg", "the same, bottom right", entry(marks.bearingsDeg, 3));
  const auto& ball = p.ball;
  visit("ball_lost", "1 when the ball was looked for and not seen (VISION_LOST)", ball.lost);
  visit("ball_distance_cm", "cm (VISION_BALL_DIST)", ball.distanceCm);
  visit("ball_angle_deg", "degrees to the left (VISION_BALL_ANGLE)", ball.angleDeg);
  visit("ball_pan_deg", "degrees to the left (VISION_PAN_DEG)", ball.panDeg);
  for (std::size_t i = 0; i < std::min(robots, seenNames.size()); ++i) {
    const auto& seen = p.robots[i];
    visit(seenNames[i].distance, "cm to this robot of the field (VISION_RBTnn_DIST)",
          seen ? seen->distanceCm : nothing);
    visit(seenNames[i].angle, "degrees to the RIGHT (VISION_RBTnn_ANGLE)",
          seen ? seen->angleDeg : nothing);
  }
  visit("search_on", "DECISION_SEARCH_ON as vision left it", p.searchOn);
  visit("voltage", "tenths of a volt (VOLTAGE)", p.voltage);
}
/// How many columns follow those of the robots.
inline constexpr std::size_t behindSeen = 2;

template <class Visit>
void visitRobot(const sim::RobotSnapshot& r, Visit&& visit) {
  visit("id", "number of the robot, of its blackboard", r.identity.id.value);
  visit("team", "0 blue, 1 red, 2 black, 3 orange, 4 yellow", static_cast<int>(r.identity.team));
  visit("number", "on the shirt", r.identity.number);
  visit("x", "m from the centre mark, to the right goal", r.pose.position.x);
  visit("y", "m, upward", r.pose.position.y);
  visit("yaw", "rad, counter-clockwise from +x", r.pose.yaw);
  visit("head_yaw", "rad, in the field's frame", r.headYaw);
  visit("velocity_x", "m/s", r.velocity.x);
  visit("velocity_y", "m/s", r.velocity.y);
  visit("action", "code that control carries out", r.action);
  visit("fallen", "1 while it lies", r.fallen);
  visit("walked_m", "m walked since the beginning", r.statistics.distanceWalked);
  visit("kicks", "kicks that moved the ball", r.statistics.kicks);
  visit("falls", "falls", r.statistics.falls);
}

/// `finished`: place of the reason in finishReasons, from 1.
template <class Visit>
void visitGame(const sim::Snapshot& s, const sim::WorldState& world, int finished, Visit&& visit) {
  visit("tick", "ticks since the beginning", s.tick);
  visit("time", "s simulated", s.time);
  visit("clock", "s of play", s.clock);
  visit("clock_running", "1 while the clock runs", s.clockRunning);
  visit("score_left", "goals of the team that defends the left goal", s.score.left);
  visit("score_right", "goals of the other team", s.score.right);
  visit("ball_x", "m from the centre mark, to the right goal", s.ball.x);
  visit("ball_y", "m, upward", s.ball.y);
  visit("ball_velocity_x", "m/s", s.ballVelocity.x);
  visit("ball_velocity_y", "m/s", s.ballVelocity.y);
  visit("finished",
        "why the scenario is over: 0 it is not, 1 goal, 2 ball out, 3 duration, 4 full time",
        finished);
  visit("play_state",
        "of a match with a referee: 0 initial, 1 ready, 2 set, 3 playing, 4 finished; "
        "else NaN",
        world.game ? static_cast<double>(world.game->state) : nothing);
}

inline constexpr std::array<std::string_view, 4> finishReasons{"goal", "ball_out", "duration",
                                                               "full_time"};
/// Place of the reason, from 1; 0 if it is empty.
inline int finishNumber(std::string_view reason) {
  const auto found = std::ranges::find(finishReasons, reason);
  return found == finishReasons.end() ? 0 : static_cast<int>(found - finishReasons.begin()) + 1;
}
/// The same text, which lasts; empty if there is no such reason.
inline std::string_view finishReason(std::string_view text) {
  const auto found = std::ranges::find(finishReasons, text);
  return found == finishReasons.end() ? std::string_view() : *found;
}

/// Fills rows one after another.
struct Filling {
  double* out;
  template <class Value>
  void operator()(std::string_view /*name*/, std::string_view /*words*/, const Value& value) {
    *out++ = number(value);
  }
  void leaveOut(std::size_t count) { out = std::fill_n(out, count, nothing); }
  void copy(std::span<const double> values) { out = std::ranges::copy(values, out).out; }
};

}  // namespace pitchboard::link::columns
