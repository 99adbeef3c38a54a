// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the robots' datagrams as a profile says they are written: text (system.md section 7),
// key=value, JSON, Lua, binary, protobuf. What the program itself uses (pose, ball, voltage) comes
// out in published units whatever the message has: TextDecoder::profile() is the profile of the
// values as they are shown.

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/wire/datagram.h>
#include <telemetry/wire/profile.h>
#include <telemetry/wire/text_errors.h>

namespace pitchboard::telemetry {

/// One decoded datagram. Memory that is used again for the next one: what lies beyond `count` is
/// left over. `words` and `extraKeys` point into the datagram, or into `made`: a copy of this has
/// dangling ones.
struct DecodedText {
  static constexpr std::size_t maxValues = 128;
  static constexpr std::size_t maxExtras = 32;  ///< keys that the profile does not name
  int robot = 0;                                ///< 0 when even that could not be read
  int place = 0;              ///< RobotKey::team, as a TeamRouter finds it; 0: there are no teams
  std::optional<int> team{};  ///< the referee's number of its team, where the message says it
  TextErrors errors;
  std::size_t badField =
      0;  ///< place of the first field with an error; errors say whether there is one
  std::size_t count = 0;                              ///< fields and extras that were read
  std::array<double, maxValues> values;               ///< NaN where the field could not be used
  std::array<std::string_view, maxValues> words;      ///< the same fields as sent
  std::array<std::string_view, maxExtras> extraKeys;  ///< of the extras, in order
  std::size_t namedExtras = 0;  ///< how many of them; extras of a message of words have no key
  std::size_t dropped = 0;      ///< values beyond maxExtras
  std::string made;             ///< words and keys of what was not sent as text

  /// The message may be used: a bad field is only missing.
  bool accepted() const { return !errors.refused(); }
  bool has(std::size_t index) const { return index < count && !std::isnan(values[index]); }
};

/// What a message does not say of itself.
struct Surroundings {
  double length = 9.0, width = 6.0;  ///< of the field, m
  bool attacksLeft = false;          ///< the sender's team plays towards −x
  /// Unit of a blackboard variable; empty function: those that the profile's meanings have.
  std::function<std::string(const std::string& variable)> unitOf{};
};

/// A profile made ready for decoding. Immutable after construction; any number of threads may use
/// one at the same time with a DecodedText of their own.
class TextDecoder {
 public:
  static constexpr std::size_t maxBytes = 65536;
  static constexpr int maxRobot = 65535 - 1240;  ///< the largest number that has a telemetry port

  /// The profile must be valid (it is when it came from parseProfile()).
  explicit TextDecoder(Profile profile = publishedProfile(), const Surroundings& where = {});
  ~TextDecoder();

  /// Of the values that come out: variables under their published names, and behind the message's
  /// own fields those that were made of them.
  const Profile& profile() const;

  /// Never reads outside the datagram. Words, key=value and binary messages allocate nothing; the
  /// others memory in proportion to the datagram. Numbers are read the same in every locale. White
  /// space and NULs after a text are ignored.
  void decode(std::string_view datagram, DecodedText& out) const;
  /// The same, and the robot's number where the message has none (Profile::robotFrom).
  void decode(const DatagramView& datagram, DecodedText& out) const;

  /// Name of a value: the profile's, then the keys that it does not name, or OTHER_1, OTHER_2, ...
  std::string name(const DecodedText& decoded, std::size_t index) const;
  static std::string otherName(std::size_t extra);  ///< "OTHER_1" of the first one
  /// The value of the field with this meaning, if the message has a usable one.
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
