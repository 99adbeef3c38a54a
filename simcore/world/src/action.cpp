// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/action.h>

#include <array>

namespace pitchboard::sim {
namespace {

// Source: SYSTEM.md section 3 and PUBLISHED_EXACT.md "Control". Products are written as published:
// step factor times step length.
constexpr double fast = 0.015 * 20;
constexpr double slow = 0.015 * 10;
constexpr double turning = 0.015 * 20;
constexpr double sidle = 0.01 * 20;
constexpr double aroundBall = 0.01 * 15;

constexpr KickRule rightKick{30, 5, 0, 12, 1.0};
constexpr KickRule leftKick{5, 30, 0, 12, 1.0};
constexpr KickRule passLeft{30, 30, 90, 8, 1.0};
constexpr KickRule passRight{30, 30, -90, 8, 1.0};

constexpr KickRule weak(KickRule rule) {
  rule.share = 0.5;
  return rule;
}

constexpr Action walk(int code, std::string_view words, double front, double turn, double drift) {
  return {code, words, ActionKind::Walk, front, turn, drift, {}, true};
}
constexpr Action kick(int code, std::string_view words, KickRule rule, bool published = true) {
  return {code, words, ActionKind::Kick, 0, 0, 0, rule, published};
}
constexpr Action other(int code, std::string_view words, ActionKind kind, bool published) {
  return {code, words, kind, 0, 0, 0, {}, published};
}

constexpr std::array<Action, 23> table{{
    other(0, "stop", ActionKind::Stop, true),
    walk(1, "walk forward, fast", fast, 0, 0),
    walk(2, "turn left", 0, turning, 0),
    walk(3, "turn right", 0, -turning, 0),
    kick(4, "kick right", rightKick),
    kick(5, "kick left", leftKick),
    walk(6, "walk left", 0, 0, sidle),
    walk(7, "walk right", 0, 0, -sidle),
    walk(8, "walk forward, slow", slow, 0, 0),
    walk(9, "around the ball, left", 0, -turning, aroundBall),
    other(10, "goalkeeper defends", ActionKind::InPlace, false),
    other(11, "gait in place", ActionKind::InPlace, true),
    kick(12, "pass left", passLeft),
    kick(13, "pass right", passRight),
    walk(14, "around the ball, right", 0, turning, -aroundBall),
    other(15, "get up from the front", ActionKind::GetUp, false),
    other(16, "get up from the back", ActionKind::GetUp, false),
    walk(17, "walk backward, fast", -fast, 0, 0),
    walk(18, "walk backward, slow", -slow, 0, 0),
    other(19, "greetings", ActionKind::InPlace, false),
    other(20, "goodbye", ActionKind::InPlace, false),
    kick(21, "kick right, weak", weak(rightKick), false),
    kick(22, "kick left, weak", weak(leftKick), false),
}};

constexpr bool codesAreIndices() {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].code != static_cast<int>(i)) return false;
  }
  return true;
}
static_assert(codesAreIndices());

}  // namespace

std::span<const Action> actionTable() {
  return table;
}

const Action* findAction(int code) {
  const bool known = code >= 0 && code < static_cast<int>(table.size());
  return known ? &table[static_cast<std::size_t>(code)] : nullptr;
}

std::string_view actionWords(int code) {
  const Action* action = findAction(code);
  return action ? action->words : std::string_view{};
}

}  // namespace pitchboard::sim
