// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The types of ROS messages, from ros2msg (rosidl's message definitions), ros1msg, and ros2idl (OMG
// IDL 4.2, the part that rosidl uses). Only what the bytes of a message depend on is kept, besides
// names and units. Private to recordings; any thread.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

#include "message_shape.h"

namespace pitchboard::telemetry {

enum class RosKind : std::uint8_t {
  Bool,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64,
  LongDouble,  ///< 16 bytes
  Text,
  WideText,
  Enumeration,  ///< 32 bits
  Time,         ///< int32 s, uint32 ns
  TimeSpan,     ///< as Time: a duration
  Struct
};

enum class RosList : std::uint8_t { One, Array, Sequence };

/// Which later versions of a type old programs can read; it decides the bytes of XCDR2.
enum class Extensibility : std::uint8_t { Unsaid, Final, Appendable, Mutable };

struct RosField {
  std::string name;
  RosKind kind = RosKind::Bool;
  RosList list = RosList::One;
  std::uint32_t count = 0;  ///< of an Array, over all its dimensions
  std::size_t type = 0;     ///< index of a Struct
  std::uint32_t id = 0;     ///< of a member of a mutable struct
  bool isOptional = false;
  bool namesElement = false;  ///< an element of a list is called by this text
  bool namesLists = false;    ///< a list of texts that name the elements of the lists beside it
  bool isStamp = false;
  std::string unit{};
  FieldLabels labels{};
  std::vector<std::int64_t> cases{};  ///< of a union: values of its first field for this one
  bool isDefaultCase = false;         ///< of a union: for all other values
};

struct RosStruct {
  std::string name;  ///< "geometry_msgs/Pose"
  std::vector<RosField> fields;
  Extensibility extensibility = Extensibility::Unsaid;
  bool isUnion = false;  ///< the first field says which of the others there is
};

struct RosTypes {
  std::vector<RosStruct> structs;
  std::size_t root = 0;
  bool isIdl = false;  ///< an empty struct has no byte
};

/// Reads ros2msg or ros1msg: the text of `type` followed by those of the types that it uses. Fails
/// with ParseError and the line.
Result<RosTypes> rosTypesFromMessage(std::string_view type, std::string_view text, bool isRos1);
/// Reads ros2idl. Fails with ParseError and the line.
Result<RosTypes> rosTypesFromIdl(std::string_view type, std::string_view text);

/// Returns the unit of a field of a type of ROS; empty if it has none.
std::string rosUnit(std::string_view type, std::string_view field);

/// Marks stamps and names, sets units, and refuses types that contain themselves.
Result<void> completeRosTypes(RosTypes& types);

/// Larger schemas are refused.
inline constexpr std::size_t maxRosText = 4U << 20;
inline constexpr std::size_t maxRosFields = 100'000;

}  // namespace pitchboard::telemetry
