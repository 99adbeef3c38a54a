// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The codes of DECISION_ACTION_A: the kind of each, and its text on cards, lanes, logs and in
// files. <simcore/world/action.h> says how control executes them; docs/reference/system.md section
// 3 has the published table. Plain values; any thread.

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
  std::string_view label;
};

/// Every known code; its index is the code.
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

/// Returns the text of a code; "action 42" if it is unknown.
std::string actionLabel(int code);

/// Returns the texts of all codes, as labels of a column.
std::map<std::int32_t, std::string> actionLabels();

}  // namespace pitchboard
