// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The order of the fields of a text datagram, as data: teams add and move fields, and a program
// that knows only the published order would show the wrong numbers (docs/LIVE.md, "Profiles").

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

enum class FieldType : std::uint8_t {
  Int,    ///< whole number that fits 32 bits
  Float,  ///< number that fits IEEE single
  Flag    ///< 0 or 1
};

/// What the program itself does with a field; None is only shown.
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
  Sequence
};
inline constexpr std::size_t fieldMeaningCount = 17;

/// "robot", "ball-distance", ...: as written in a profile.
std::string_view meaningName(FieldMeaning meaning);

struct ProfileField {
  std::string name;  ///< e.g. "BALL_DIST"
  FieldType type = FieldType::Float;
  std::string unit;      ///< for the screen, e.g. "cm"; may be empty
  std::string category;  ///< under which it is shown; may be empty
  FieldMeaning meaning = FieldMeaning::None;
  std::optional<double> absent{};  ///< the value that says "not seen": a hole in every curve
  int bits = 0;                    ///< of a Sequence, 8, 16 or 32; 0: not known (SequenceStats)
  bool operator==(const ProfileField&) const = default;
};

/// A valid one has exactly one Robot field, unique names and at most maxFields fields.
struct Profile {
  static constexpr std::size_t maxFields = 100;
  std::string name;
  std::string end = "OUT";  ///< the word that ends a message
  std::vector<ProfileField> fields;

  /// Place of the field with this meaning; empty when the profile has none.
  std::optional<std::size_t> indexOf(FieldMeaning meaning) const;
  bool operator==(const Profile&) const = default;
};

/// The published order (resources/profiles/published.json).
const Profile& publishedProfile();

/// Reads a profile; `file` is only for the messages. Errors: ParseError with "file:line: key".
Result<Profile> parseProfile(std::string_view json, const std::string& file);
/// Errors as parseProfile(), and NotFound or SystemError for a file that cannot be read.
Result<Profile> loadProfile(const std::string& path);
/// Text that parseProfile() reads back to the same value; for saving an edited profile.
std::string profileText(const Profile& profile);
/// Checks a profile made by hand. The error's context names the field.
Result<void> validate(const Profile& profile);

}  // namespace pitchboard::telemetry
