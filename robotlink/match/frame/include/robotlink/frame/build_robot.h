// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes what is shown of a robot from the values of a blackboard, a message or a recorded row.
// Every source uses it and provides only a function that reads single values. Use each object on
// one thread.

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/formats/meanings.h>

namespace pitchboard::link {

/// Returns a value in the unit of telemetry::info(); empty if the source does not have it. Control
/// to Imu are flags; BallSeen is 0 or less for a lost ball.
using RobotReader = std::function<std::optional<double>(telemetry::FieldMeaning)>;

/// Converts the value of a blackboard variable to that of its meaning: VISION_LOST is the opposite
/// of BallSeen.
constexpr double meantBy(telemetry::FieldMeaning meaning, double variable) {
  return meaning == telemetry::FieldMeaning::BallSeen ? 1.0 - variable : variable;
}

/// For this time (s) after its flag was last set, a process counts as working, because the flag is
/// cleared and set again continuously.
inline constexpr double flagMemory = 1.0;

/// Remembers since when each process of a robot works or does not respond. The state of a process
/// that has never worked is unknown.
class LampMemory {
 public:
  using Lamps = std::array<telemetry::ProcessHeartbeat, telemetry::processCount>;
  /// Reads the flags and returns the states. `time` (s) must not decrease; it stands still while
  /// the match is paused.
  const Lamps& note(const RobotReader& reader, double time);
  /// Records that the flag of this process was set at `time`, between two calls of note().
  void saw(std::size_t lamp, double time);
  /// Forgets all flags, because the next time does not follow the last one.
  void jump() { m_seen = never; }

 private:
  static constexpr auto never = [] {
    std::array<double, telemetry::processCount> seen{};
    seen.fill(-std::numeric_limits<double>::infinity());
    return seen;
  }();
  std::array<double, telemetry::processCount> m_seen = never, m_since{};
  Lamps m_lamps{};
};

/// Fills belief, ball, decided action and battery of `robot`. Its lamps, its link and, if
/// `truthKnown`, its pose must already be set; otherwise the pose becomes the believed one.
/// `battery` has the limits of the robot's model.
void buildRobot(const RobotReader& reader, const sim::FieldSpec& field,
                const telemetry::BatteryLimits& battery, bool truthKnown, RobotFrame& robot);

/// Returns the battery limits of a robot model. They are of the whole battery, as if it had one
/// cell.
constexpr telemetry::BatteryLimits batteryLimitsOf(const sim::RobotModel& model) {
  return {1, model.batteryFull, model.batteryLow, model.batteryEmpty};
}

/// Returns where the robots of each team agree that the ball is. Teams in which no two robots agree
/// are left out.
std::vector<TeamBall> agreedBalls(std::span<const RobotFrame> robots);

}  // namespace pitchboard::link
