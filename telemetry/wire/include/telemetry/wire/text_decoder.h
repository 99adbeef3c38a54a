// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads the robots' text datagrams (SYSTEM.md section 7) in the order that a profile gives.

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/wire/profile.h>
#include <telemetry/wire/text_errors.h>

namespace pitchboard::telemetry {

/// One decoded datagram. Plain memory that is used again for the next one: what lies beyond
/// `count` is left over. `words` point into the datagram.
struct DecodedText {
  static constexpr std::size_t maxValues = 128;
  int robot = 0;  ///< 0 when even that could not be read
  TextErrors errors;
  std::size_t badField =
      0;  ///< place of the first field with an error; errors say whether there is one
  std::size_t count = 0;                          ///< fields and extras that were read
  std::array<double, maxValues> values;           ///< NaN where the field could not be used
  std::array<std::string_view, maxValues> words;  ///< the same fields as sent

  /// The message may be used: a bad field is only missing.
  bool accepted() const { return !errors.refused(); }
  bool has(std::size_t index) const { return index < count && !std::isnan(values[index]); }
};

/// A profile made ready for decoding. Immutable after construction; any number of threads may use
/// one at the same time with a DecodedText of their own.
class TextDecoder {
 public:
  static constexpr std::size_t maxBytes = 65536;
  static constexpr int maxRobot = 65535 - 1240;  ///< the largest number that has a telemetry port

  /// The profile must be valid (it is when it came from parseProfile()).
  explicit TextDecoder(Profile profile = publishedProfile());

  const Profile& profile() const { return m_profile; }

  /// Never allocates and never reads outside the text. Numbers are read the same in every locale.
  /// Trailing white space and NULs are ignored.
  void decode(std::string_view datagram, DecodedText& out) const;

  /// Name of a value: the profile's, then OTHER_1, OTHER_2, ...
  std::string name(std::size_t index) const;
  /// The value of the field with this meaning, if the message has a usable one.
  std::optional<double> value(const DecodedText& decoded, FieldMeaning meaning) const;

 private:
  Profile m_profile;
  std::array<std::size_t, fieldMeaningCount> m_places{};  ///< DecodedText::maxValues: none
};

}  // namespace pitchboard::telemetry
