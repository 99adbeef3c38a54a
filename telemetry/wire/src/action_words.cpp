// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/action_words.h>

#include <array>
#include <string_view>

namespace pitchboard::telemetry {

namespace {

constexpr std::array<std::string_view, 23> words{"stop",
                                                 "walk forward fast",
                                                 "turn left",
                                                 "turn right",
                                                 "kick right",
                                                 "kick left",
                                                 "walk left",
                                                 "walk right",
                                                 "walk forward slow",
                                                 "turn around the ball left",
                                                 "defend the goal",
                                                 "gait in place",
                                                 "pass left",
                                                 "pass right",
                                                 "turn around the ball right",
                                                 "get up from the front",
                                                 "get up from the back",
                                                 "walk backward fast",
                                                 "walk backward slow",
                                                 "greet",
                                                 "say goodbye",
                                                 "kick right weak",
                                                 "kick left weak"};

}  // namespace

std::string actionWords(int code) {
  if (code < 0 || static_cast<std::size_t>(code) >= words.size()) {
    return "action " + std::to_string(code);
  }
  return std::string(words[static_cast<std::size_t>(code)]);
}

std::map<std::int32_t, std::string> actionLabels() {
  std::map<std::int32_t, std::string> out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    out.emplace(static_cast<std::int32_t>(i), std::string(words[i]));
  }
  return out;
}

}  // namespace pitchboard::telemetry
