// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Says what the topics of another program's recording mean: which robot's pose, ball, battery they
// hold, what is the log, what the referee. builtInMapping() knows the usual messages of ROS; other
// mappings are JSON files (docs/other-robots.md). Plain values and pure functions; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <base/team_color.h>
#include <robotlink/frame/teams.h>
#include <simcore/world/field.h>
#include <telemetry/recordings/recording.h>

namespace pitchboard::link {

/// Where positions on the field are counted from.
enum class MappedFrame : std::uint8_t {
  Centre,     ///< the centre mark, +x to the opponents' goal, y left
  Studio,     ///< the centre mark, +x to the right goal, y up
  BottomLeft  ///< the corner on the left below, x right, y up
};

/// A robot's pose in a message. Paths are those of RecordedField.
struct MappedPose {
  std::string topic;
  std::string x, y;
  std::string yaw;          ///< or `orientation`
  std::string orientation;  ///< path of a quaternion with x, y, z, w
  std::string unit = "m";
  std::string angleUnit = "rad";
  MappedFrame frame = MappedFrame::Centre;
  std::string covariance;  ///< path of 36 numbers, row by row over x, y, z, roll, pitch, yaw
  std::string sigma;       ///< or the path of a standard deviation, in `unit`
  /// Of several poses of a robot the one with the highest counts.
  int priority = 2;
  bool operator==(const MappedPose&) const = default;
};

/// A pose in a tree of transforms: the topic has messages tf2_msgs/TFMessage.
struct MappedTransforms {
  std::string topic;
  std::string root;  ///< frame of the field: "map"; empty: the usual names
  std::string base;  ///< frame of the robot: "robot1/base_link"; empty: the usual names
  MappedFrame frame = MappedFrame::Centre;
  bool operator==(const MappedTransforms&) const = default;
};

/// The ball that a robot sees: in its own frame (x forward, y left, or distance and angle), or on
/// the field.
struct MappedBall {
  std::string topic;
  std::string x, y;
  std::string distance, angle;  ///< angle: left positive
  std::string seen;             ///< a flag; empty: every message has a ball
  std::string unit = "m";
  std::string angleUnit = "rad";
  std::optional<MappedFrame> frame;  ///< empty: the robot's own
  bool operator==(const MappedBall&) const = default;
};

struct MappedBattery {
  std::string topic;
  std::string volts, charge;  ///< charge: 0 to 1
  std::string unit = "V";
  std::optional<double> full, low, empty;  ///< V; else they follow from the voltage
  bool operator==(const MappedBattery&) const = default;
};

/// Whether a robot lies on the ground, by its IMU or by a flag.
struct MappedFallen {
  std::string topic;
  std::string orientation;  ///< path of a quaternion
  std::string flag;
  bool operator==(const MappedFallen&) const = default;
};

struct MappedRobot {
  int number = 0;
  TeamColor team = TeamColor::Blue;
  std::string name;
  bool attacksLeft = false;  ///< the team plays towards the left goal; for MappedFrame::Centre
  std::vector<MappedPose> poses;
  std::optional<MappedTransforms> transforms;
  std::optional<MappedBall> ball;
  std::optional<MappedBattery> battery;
  std::optional<MappedFallen> fallen;
  bool operator==(const MappedRobot&) const = default;
};

struct MappedLog {
  std::string topic, text, level, origin;  ///< level and origin may be empty
  bool operator==(const MappedLog&) const = default;
};

/// A referee's state in messages of a robot. Codes of `state` are those of the GameController: 0
/// initial, 1 ready, 2 set, 3 playing, 4 finished.
struct MappedReferee {
  std::string topic;
  std::string state, secondsLeft, firstHalf, leftScore, rightScore;  ///< may be empty
  TeamColor left = TeamColor::Blue, right = TeamColor::Red;
  bool operator==(const MappedReferee&) const = default;
};

/// Which time of a message counts.
enum class RecordingClock : std::uint8_t {
  Auto,    ///< as Header, unless the first of a file is more than a minute from its log time
  Header,  ///< when it was measured, if the message says so
  Log      ///< when it was recorded
};

/// A file that is not a part of a split recording but one of several recordings of a match.
struct MappedRecording {
  std::string file;  ///< its name without folders
  RecordingClock clock = RecordingClock::Auto;
  double offset = 0.0;  ///< s, added to its times
  bool operator==(const MappedRecording&) const = default;
};

/// Something that happens once in a match, and that recordings of it have in common.
enum class AlignEvent : std::uint8_t {
  KickOff,  ///< PLAYING begins
  Set       ///< SET begins, before the kick-off
};
/// "kick-off", "set", in the order of AlignEvent.
inline constexpr std::array<std::string_view, 2> alignEventNames{"kick-off", "set"};
constexpr std::string_view nameOf(AlignEvent event) {
  return alignEventNames[static_cast<std::size_t>(event)];
}

struct TopicMapping {
  std::string field;  ///< name of a field (docs/scenarios.md); empty: the default
  std::vector<MappedRobot> robots;
  std::vector<MappedLog> log;
  std::optional<MappedReferee> referee;
  std::vector<MappedRecording> recordings;
  std::optional<AlignEvent> alignedBy;  ///< what the offsets follow from; empty: set by hand, or 0
  bool operator==(const TopicMapping&) const = default;
};

/// Returns what is usual for topics of these types. A namespace is a robot ("/robot3/..."), whose
/// number is that in its name.
TopicMapping builtInMapping(std::span<const telemetry::RecordedTopic> topics);
/// Returns the number at the end of a robot's name, as in "robot3"; nothing if there is none from 1
/// to 99.
std::optional<int> numberOfName(const std::string& name);

/// Reads a mapping. Fails with ParseError or InvalidArgument, the line and the key.
Result<TopicMapping> mappingFromJson(std::string_view text, const std::string& name);
Result<TopicMapping> mappingFromFile(const std::string& path);
/// Returns a mapping as the text of a file, which reads back to the same mapping.
std::string mappingText(const TopicMapping& mapping);

}  // namespace pitchboard::link
