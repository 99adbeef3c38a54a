// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decodes robots' datagrams as a profile describes them: text (system.md section 7), key=value,
// JSON, Lua, binary, protobuf. Values that Pitchboard itself uses (pose, ball, voltage) are
// converted to published units. TextDecoder::profile() describes the values that come out.

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/formats/profile.h>
#include <telemetry/formats/text_errors.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// A decoded datagram. Its memory is reused for the next one, so ignore what lies beyond `count`.
/// `texts` and `extraKeys` point into the datagram or into `made`; in a copy of this they dangle.
struct DecodedText {
  static constexpr std::size_t maxValues = 128;
  static constexpr std::size_t maxExtras = 32;  ///< values that the profile does not name
  int robot = 0;                                ///< 0 if even that could not be read
  int place = 0;              ///< RobotKey::team, from a TeamRouter; 0 without teams
  std::optional<int> team{};  ///< number of its team in the GameController, if the message has it
  TextErrors errors;
  std::size_t badField = 0;  ///< index of the first field with an error, if there are errors
  std::size_t count = 0;     ///< number of fields and extras that were read
  std::array<double, maxValues> values;               ///< NaN if the field could not be used
  std::array<std::string_view, maxValues> texts;      ///< the same fields as sent
  std::array<std::string_view, maxExtras> extraKeys;  ///< keys of the extras, in order
  std::size_t namedExtras = 0;  ///< number of keys; extras of a message without keys have none
  std::size_t dropped = 0;      ///< number of values beyond maxExtras
  std::string made;             ///< memory of texts and keys that were not sent as text

  /// Returns whether the message can be used; a bad field is only missing.
  bool accepted() const { return !errors.refused(); }
  bool has(std::size_t index) const { return index < count && !std::isnan(values[index]); }
};

/// What a message does not say about itself.
struct Surroundings {
  double length = 9.0, width = 6.0;  ///< m, size of the field
  bool attacksLeft = false;          ///< the sender's team attacks towards −x
  /// Returns the unit of a blackboard variable. If it is empty, those of the meanings are used.
  std::function<std::string(const std::string& variable)> unitOf{};
};

/// A profile that is prepared for decoding. Immutable; several threads may use it at the same time,
/// each with its own DecodedText.
class TextDecoder {
 public:
  static constexpr std::size_t maxBytes = 65536;
  static constexpr int maxRobot = 65535 - 1240;  ///< the largest number that has a telemetry port

  /// The profile must be valid, as parseProfile() returns it.
  explicit TextDecoder(Profile profile = publishedProfile(), const Surroundings& where = {});
  ~TextDecoder();

  /// Describes the values that come out: variables have their published names, and values that were
  /// converted follow the message's own fields.
  const Profile& profile() const;

  /// Decodes a datagram into `out`. It never reads outside the datagram. Words, key=value and
  /// binary messages allocate nothing, other formats memory in proportion to the datagram. The
  /// locale has no influence. White space and NULs after a text are ignored.
  void decode(std::string_view datagram, DecodedText& out) const;
  /// The same, and takes the robot's number from the sender if the message has none
  /// (Profile::robotFrom).
  void decode(const DatagramView& datagram, DecodedText& out) const;

  /// Returns the name of a value: that of the profile, then the keys of extras, or OTHER_1, ...
  std::string name(const DecodedText& decoded, std::size_t index) const;
  static std::string otherName(std::size_t extra);  ///< "OTHER_1" for the first one
  /// Returns the value of the field with this meaning, if the message has a usable one.
  std::optional<double> value(const DecodedText& decoded, FieldMeaning meaning) const;

 private:
  struct Plan;
  void decodeWords(std::string_view datagram, DecodedText& out) const;
  void decodeFields(std::string_view datagram, DecodedText& out) const;
  void findRobot(DecodedText& out) const;
  void publish(DecodedText& out) const;

  std::unique_ptr<const Plan> m_plan;
  std::array<std::size_t, fieldMeaningCount> m_indices{};  ///< DecodedText::maxValues: none
};

}  // namespace pitchboard::telemetry
