// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Compares a text with a pattern in which * stands for any letters, also none. Pure; any thread.

#include <string_view>

namespace pitchboard {

/// Returns whether the whole text fits. Takes a time that is linear in the text for every *.
constexpr bool fitsWildcard(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace pitchboard
