// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The places of a mapping (topic_mapping.h) into which fields of messages can be put one by one:
// "x of robot 3". Plain values and pure functions; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/live/topic_mapping.h>

namespace pitchboard::link {

enum class MappingSlot : std::uint8_t {
  PoseX,
  PoseY,
  PoseHeading,  ///< an angle, or a quaternion
  PoseCovariance,
  PoseSigma,
  Transforms,  ///< a whole topic
  BallX,
  BallY,
  BallDistance,
  BallAngle,
  BallSeen,
  BatteryVolts,
  BatteryCharge,
  Fallen,  ///< a flag, or a quaternion
  LogText,
  LogLevel,
  LogOrigin,
  RefereeState,
  RefereeSecondsLeft,
  RefereeFirstHalf,
  RefereeLeftScore,
  RefereeRightScore
};

struct MappingSlotInfo {
  MappingSlot slot;
  std::string_view part;  ///< "Pose": all fields of a part come from one topic
  std::string_view name;  ///< "x"
  bool isOfRobot;
};
std::span<const MappingSlotInfo> mappingSlots();
const MappingSlotInfo& info(MappingSlot slot);

/// A field of a topic. A path can also be that of several fields: of a quaternion, of a covariance.
struct TopicField {
  std::string topic, path;
  bool isEmpty() const { return topic.empty(); }
  bool operator==(const TopicField&) const = default;
};

/// Returns what is in a place. `robot` is an index in TopicMapping::robots, which must exist for
/// places of robots and does not count for others.
TopicField fieldIn(const TopicMapping& mapping, std::size_t robot, MappingSlot slot);
/// Puts a field into a place; an empty one clears it. A part with nothing in it goes. Fields of the
/// part that are of another topic go, too, and are returned as the names of their places. `fields`
/// are those of the topic: with a component of a quaternion or an element of a covariance, the
/// whole is put where it is needed.
std::vector<std::string> putField(TopicMapping& mapping, std::size_t robot, MappingSlot slot,
                                  TopicField field,
                                  std::span<const telemetry::RecordedField> fields);

/// A topic of a recording, and the fields of its messages.
struct TopicFields {
  telemetry::RecordedTopic topic;
  std::vector<telemetry::RecordedField> fields;
};
/// Why a mapping cannot be used, or not for these topics.
struct MappingProblem {
  std::string sentence;
  bool isError = false;  ///< the mapping cannot be saved like this
  std::optional<std::size_t> robot{};
  bool operator==(const MappingProblem&) const = default;
};
std::vector<MappingProblem> problemsOf(const TopicMapping& mapping,
                                       std::span<const TopicFields> topics);

}  // namespace pitchboard::link
