// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one way from what a blackboard, a message or a recorded row says of a robot to what is shown
// of it. A source only tells values. One thread for each object.

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <telemetry/wire/meanings.h>

namespace pitchboard::link {

/// A value in the unit of telemetry::info(); nothing: the source does not know it. Control to Imu
/// are flags, BallSeen is 0 or less for a ball that is lost.
using RobotReader = std::function<std::optional<double>(telemetry::FieldMeaning)>;

/// What a blackboard's variable says: VISION_LOST is the opposite of BallSeen.
constexpr double meantBy(telemetry::FieldMeaning meaning, double variable) {
  return meaning == telemetry::FieldMeaning::BallSeen ? 1.0 - variable : variable;
}

/// Seconds for which a process counts as working after its flag was last seen set: the flag is
/// cleared and set again all the time.
inline constexpr double flagMemory = 1.0;

/// Since when each process of one robot works or is silent. One that was never seen working is
/// unknown, not silent.
class LampMemory {
 public:
  using Lamps = std::array<telemetry::ProcessHeartbeat, telemetry::processCount>;
  /// `time`: s, never less than before; it stands still while the processes may rest.
  const Lamps& note(const RobotReader& reader, double time);
  /// The flag of this process was set at that time, within flagMemory of the next note().
  void saw(std::size_t lamp, double time);
  /// The next time is another one: what was set before does not count any more.
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

/// Belief, ball, decided action, battery and advice. `robot` has its lamps, link and, where the
/// truth is known, its pose; else the pose becomes what it believes. `advice` may be empty.
void buildRobot(const RobotReader& reader, const AdviceReader& advice, const sim::FieldSpec& field,
                bool truthKnown, RobotFrame& robot);

/// Where the robots of each team agree that the ball is; teams of which no two do are left out.
std::vector<TeamBall> agreedBalls(std::span<const RobotFrame> robots);

}  // namespace pitchboard::link
