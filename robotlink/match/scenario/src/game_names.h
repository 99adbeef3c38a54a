// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The names of states, phases, set plays and penalties in files: the labels of the screen in
// small letters, with '_' between them. Private to robotlink/scenario.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <base/game.h>

namespace pitchboard::link {

inline std::string keyOf(std::string_view label) {
  std::string key;
  for (const char c : label) {
    key += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c == ' ' || c == '-' ? '_' : c;
  }
  return key;
}

/// In the order of the values. `none` stands for a value without a label.
template <class Enum>
const std::vector<std::string>& keysOf(std::string_view none = {}) {
  static const std::vector<std::string> all = [none] {
    std::vector<std::string> keys;
    for (int i = 0; i <= static_cast<int>(lastOf(Enum{})); ++i) {
      const std::string_view label = labelOf(static_cast<Enum>(i));
      keys.push_back(label.empty() ? std::string(none) : keyOf(label));
    }
    return keys;
  }();
  return all;
}

constexpr std::string_view kickOffKey = "kick_off", noPenaltyKey = "none";
inline const std::vector<std::string>& setPlayKeys() {
  return keysOf<SetPlay>(kickOffKey);
}
inline const std::vector<std::string>& penaltyKeys() {
  return keysOf<PenaltyKind>(noPenaltyKey);
}
/// Of Restart::Step and ClockUse.
inline constexpr std::array<std::string_view, 5> stepKeys{"free", "placing", "preparing", "taking",
                                                          "executed"};
inline constexpr std::array<std::string_view, 3> clockUseKeys{"full", "began_now", "began"};
static_assert(stepKeys.size() == std::size_t(lastOf(Restart::Step{})) + 1);
static_assert(clockUseKeys.size() == std::size_t(lastOf(ClockUse{})) + 1);

}  // namespace pitchboard::link
