// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The names in profile files, in the order of the enumerations of profile.h. Any thread.

#include <array>
#include <string_view>

#include <base/byte_sizes.h>
#include <telemetry/formats/meanings.h>

namespace pitchboard::telemetry::profile_names {

inline constexpr auto meaningNames = [] {
  std::array<std::string_view, fieldMeaningCount> keys;
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = meaningTable[i].profileKey;
  return keys;
}();
inline constexpr std::array<std::string_view, 4> types{"int", "float", "flag", "text"};
inline constexpr std::array<std::string_view, messageFormatCount> formats{
    "words", "key=value", "json", "lua", "binary", "mitecom", "hulks", "cit-brains", "protobuf"};
inline constexpr std::array<std::string_view, wireTypeCount> wireTypes{
    "none", "u8", "i8", "u16", "i16", "u24", "u32", "i32", "u64", "i64", "f32", "f64", "text"};
inline constexpr std::array<std::string_view, 2> origins{"corner", "centre"};
inline constexpr std::array<std::string_view, 3> xAxes{"right", "left", "opponents"};
inline constexpr std::array<std::string_view, 2> yAxes{"right", "left"};
inline constexpr std::array<std::string_view, 2> angles{"counter-clockwise", "clockwise"};
inline constexpr std::array<std::string_view, 3> robotSources{"message", "port", "address"};
inline constexpr std::array<std::string_view, 2> encodings{"ascii", "utf-8"};
inline constexpr std::array<std::string_view, 4> messages{"robocup", "nubots", "rhoban", "utra"};

static_assert(!formats.back().empty() && !wireTypes.back().empty(),
              "every value of an enumeration of profile.h needs its word here");

inline constexpr std::size_t maxNameBytes = 60;
inline constexpr std::size_t maxFileBytes = mebibyte;
inline constexpr std::size_t maxLabels = 64;
inline constexpr std::size_t maxConditions = 8;
inline constexpr int maxOffset = 65535;

/// Bytes of a number on the wire; 0 for a text.
constexpr int bytesOf(WireType type) {
  constexpr std::array<int, wireTypeCount> bytes{0, 1, 1, 2, 2, 3, 4, 4, 8, 8, 4, 8, 0};
  return bytes[static_cast<std::size_t>(type)];
}

}  // namespace pitchboard::telemetry::profile_names
