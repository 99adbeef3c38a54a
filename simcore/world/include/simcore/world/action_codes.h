// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The codes of DECISION_ACTION_A: of which kind each one is, and what people read for it on cards,
// lanes, logs and in files. How control carries them out is told in <simcore/world/action.h>, the
// published table in docs/reference/system.md section 3. Plain values; any thread.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace pitchboard {

enum class ActionKind : std::uint8_t { Stop, Walk, Kick, InPlace, GetUp };

struct ActionInfo {
  int code = 0;
  ActionKind kind = ActionKind::Stop;
  std::string_view words;
};

/// Every code that a robot knows; a code is its place.
inline constexpr std::array<ActionInfo, 23> knownActions{{
    {0, ActionKind::Stop, "stop"},
    {1, ActionKind::Walk, "walk forward, fast"},
    {2, ActionKind::Walk, "turn left"},
    {3, ActionKind::Walk, "turn right"},
    {4, ActionKind::Kick, "kick right"},
    {5, ActionKind::Kick, "kick left"},
    {6, ActionKind::Walk, "walk left"},
    {7, ActionKind::Walk, "walk right"},
    {8, ActionKind::Walk, "walk forward, slow"},
    {9, ActionKind::Walk, "around the ball, left"},
    {10, ActionKind::InPlace, "goalkeeper defends"},
    {11, ActionKind::InPlace, "gait in place"},
    {12, ActionKind::Kick, "pass left"},
    {13, ActionKind::Kick, "pass right"},
    {14, ActionKind::Walk, "around the ball, right"},
    {15, ActionKind::GetUp, "get up from the front"},
    {16, ActionKind::GetUp, "get up from the back"},
    {17, ActionKind::Walk, "walk backward, fast"},
    {18, ActionKind::Walk, "walk backward, slow"},
    {19, ActionKind::InPlace, "greetings"},
    {20, ActionKind::InPlace, "goodbye"},
    {21, ActionKind::Kick, "kick right, weak"},
    {22, ActionKind::Kick, "kick left, weak"},
}};

static_assert([] {
  for (std::size_t i = 0; i < knownActions.size(); ++i) {
    if (knownActions[i].code != static_cast<int>(i)) return false;
  }
  return true;
}());

/// The words of any code; "action 42" for one that no robot knows.
std::string actionWords(int code);

/// The whole table: the labels of a column of actions.
std::map<std::int32_t, std::string> actionLabels();

}  // namespace pitchboard
