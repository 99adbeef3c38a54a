// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks the short names of scenarios, experiments and runtime profiles, which are also names of
// files and arguments on command lines. Pure functions; any thread.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <base/lined_json.h>

namespace pitchboard {

inline constexpr std::size_t maxShortNameLength = 64;

constexpr bool isShortNameLetter(char c) {
  return std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.")
             .find(c) != std::string_view::npos;
}

/// Returns the short name under `key`, or `fallback` if there is none. Other characters are errors.
inline std::string readShortName(const JsonObject& object, std::string_view key,
                                 std::string fallback, std::size_t longest = maxShortNameLength) {
  std::string name = object.text(key, std::move(fallback), longest);
  if (object.find(key) && (name.empty() || !std::ranges::all_of(name, isShortNameLetter))) {
    object.fail(key, "must consist of letters, digits, '-', '_' and '.'");
  }
  return name;
}

}  // namespace pitchboard
