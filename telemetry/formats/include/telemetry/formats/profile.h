// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A profile describes a team's messages: where each value is, what it means, and in which unit
// and frame (docs/live.md, "Profiles"). Plain values; any thread.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

enum class FieldType : std::uint8_t {
  Int,    ///< whole number that fits 32 bits
  Float,  ///< number that fits IEEE single
  Flag,   ///< 0 or 1
  Text    ///< a text; a number only if `labels` have one for it
};

/// How a datagram is written.
enum class MessageFormat : std::uint8_t {
  Words,      ///< values in a fixed order
  KeyValue,   ///< key=value
  Json,       ///< one object, flattened: "pose.x", "ball[0]"
  Lua,        ///< one table as text, flattened as JSON
  Binary,     ///< numbers at fixed places, little-endian
  Mitecom,    ///< RoboCup-Humanoid-TC/mitecom: numbered values; keys "team", "robot", "0x10000"
  Hulks,      ///< HULKs of 2024 on: 25 or 45 bytes
  CitBrains,  ///< CIT Brains: seven packed objects
  Protobuf    ///< Profile::message says which one
};
inline constexpr std::size_t messageFormatCount = 9;
std::string_view formatName(MessageFormat format);

/// A number of a binary message.
enum class WireType : std::uint8_t {
  None,
  U8,
  I8,
  U16,
  I16,
  U24,
  U32,
  I32,
  U64,
  I64,
  F32,
  F64,
  Text
};
inline constexpr std::size_t wireTypeCount = 13;

/// What Pitchboard uses a field for; a field with None is only shown.
enum class FieldMeaning : std::uint8_t {
  None,
  Robot,
  X,
  Y,
  Theta,
  Belief,
  BallDistance,
  BallAngle,
  Control,
  Vision,
  Localization,
  Decision,
  Imu,  ///< processes, in the order of the message
  Action,
  Yaw,
  Voltage,
  Sequence,
  Team,  ///< number of its team in the GameController
  BallX,
  BallY,  ///< from the robot: ahead, left
  BallFieldX,
  BallFieldY,  ///< in the frame of x and y
  BallSeen,    ///< 0 or less: the other values of the ball mean nothing
  BallAge,     ///< less than 0: never seen; more than 2 s: no longer seen
  Charge       ///< how full the battery is
};
inline constexpr std::size_t fieldMeaningCount = 25;

/// "robot", "ball-distance", ...: as written in a profile.
std::string_view meaningName(FieldMeaning meaning);

struct ProfileField {
  std::string name;  ///< e.g. "BALL_DIST"
  FieldType type = FieldType::Float;
  std::string unit;      ///< unit for people, e.g. "cm"; may be empty
  std::string category;  ///< category under which it is listed; may be empty
  FieldMeaning meaning = FieldMeaning::None;
  /// The blackboard variable that it is, whose name and unit it then gets; empty if none.
  std::string variable{};
  std::string key{};   ///< its name in the message; empty: `name`
  double scale = 1.0;  ///< value in `unit` = scale × what is sent + offset
  double offset = 0.0;
  std::optional<double> absent{};                ///< the value that means "nothing"
  std::map<std::int32_t, std::string> labels{};  ///< texts of codes, and codes of texts
  int bits = 0;  ///< size of a sequence number that wraps; 0 if unknown
  // Of a binary message.
  int at = 0;  ///< position in bytes
  WireType as = WireType::None;
  int length = 0;          ///< length of a Text in bytes
  std::uint32_t mask = 0;  ///< bits that count; 0: all
  bool optional = false;   ///< the message may end before it; otherwise it counts as truncated
  bool operator==(const ProfileField&) const = default;
  const std::string& sentName() const { return key.empty() ? name : key; }
};

/// The frame of x, y, theta and a ball on the field. The default is that of LOCALIZATION_X, _Y,
/// _THETA (CONVENTIONS.md).
struct MessageFrame {
  enum class XAxis : std::uint8_t { Right, Left, Opponents };
  bool centre = false;     ///< origin: the centre mark; false: the corner where x and y are 0
  XAxis x = XAxis::Right;  ///< to which goal +x points
  bool yLeft = false;      ///< +y points to the left of +x; false: to its right
  bool clockwise = false;  ///< how angles grow, from +x
  bool operator==(const MessageFrame&) const = default;
};

/// Where the robot's number comes from if the message has none.
struct RobotFrom {
  enum class Source : std::uint8_t { Message, Port, Address };
  Source source = Source::Message;
  int base = 0;  ///< number = port − base, or last byte of the sender's address − base
  bool operator==(const RobotFrom&) const = default;
};

/// A binary message belongs to this profile only if one of these values is here.
struct WireCondition {
  int at = 0;
  WireType as = WireType::U8;
  std::vector<std::int64_t> values;
  bool operator==(const WireCondition&) const = default;
};

/// A valid profile has exactly one source of the robot's number, unique names, and at most
/// maxFields fields.
struct Profile {
  static constexpr std::size_t maxFields = 100;
  std::string name;
  std::string end =
      "OUT";  ///< last value of a message without keys; empty: the end of the datagram
  std::vector<ProfileField> fields;
  MessageFormat format = MessageFormat::Words;
  MessageFrame frame;
  RobotFrom robotFrom;
  char separator = ' ';   ///< between values or pairs; ' ': any white space
  bool utf8 = false;      ///< allow UTF-8 in messages without keys; other texts always may
  bool tolerant = false;  ///< use what precedes an error in JSON or Lua
  std::string begins;     ///< bytes that a binary message begins with
  std::vector<WireCondition> when;
  std::string message;  ///< of the format protobuf: "robocup", "nubots", "rhoban", "utra"

  /// Returns the index of the field with this meaning, if there is one.
  std::optional<std::size_t> indexOf(FieldMeaning meaning) const;
  bool operator==(const Profile&) const = default;
};

/// Returns the profile of the published message (resources/profiles/published.json).
const Profile& publishedProfile();
/// Returns the names of the built-in profiles (resources/profiles), in order.
std::vector<std::string> builtInProfiles();

/// Reads a profile; `file` is used in messages only. Fails with ParseError and "file:line: key".
Result<Profile> parseProfile(std::string_view json, const std::string& file);
/// Reads a file, or returns the built-in profile of this name. Fails as parseProfile() does, and
/// with NotFound or SystemError if the file cannot be read.
Result<Profile> loadProfile(const std::string& pathOrName);
/// Returns a text that parseProfile() reads back to the same value.
std::string profileText(const Profile& profile);
/// Checks a profile that was made in code. The error's context names the field.
Result<void> validate(const Profile& profile);

}  // namespace pitchboard::telemetry
