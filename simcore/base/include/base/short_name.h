// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the short names of scenarios, experiments and runtime profiles may be made of: they are
// names of files and words of a command line, too. Pure.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <base/lined_json.h>

namespace pitchboard {

inline constexpr std::size_t longestShortName = 64;

constexpr bool isShortNameLetter(char c) {
  return std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.")
             .find(c) != std::string_view::npos;
}

/// The short name under `key`; `fallback` when there is none. Complains about any other letter.
inline std::string readShortName(const JsonObject& object, std::string_view key,
                                 std::string fallback, std::size_t longest = longestShortName) {
  std::string name = object.text(key, std::move(fallback), longest);
  if (object.find(key) && (name.empty() || !std::ranges::all_of(name, isShortNameLetter))) {
    object.fail(key, "must consist of letters, digits, '-', '_' and '.'");
  }
  return name;
}

}  // namespace pitchboard
