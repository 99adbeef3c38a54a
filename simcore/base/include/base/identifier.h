// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks names that stand in expressions and tables, such as those of metrics and rules: letters,
// digits and '_', beginning with a letter or '_'. Pure function; any thread.

#include <algorithm>
#include <string_view>

namespace pitchboard {

constexpr bool isIdentifier(std::string_view name) {
  const auto isLetter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && isLetter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace pitchboard
