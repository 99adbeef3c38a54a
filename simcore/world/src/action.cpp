// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/action.h>

#include <array>

namespace pitchboard::sim {
namespace {

// Source: system.md section 3 and published-exact.md "Control". Products are written as published:
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

constexpr Action walk(std::size_t code, double front, double turn, double drift) {
  return {knownActions[code], front, turn, drift, {}, true};
}
constexpr Action kick(std::size_t code, KickRule rule, bool published = true) {
  return {knownActions[code], 0, 0, 0, rule, published};
}
constexpr Action still(std::size_t code, bool published) {
  return {knownActions[code], 0, 0, 0, {}, published};
}

constexpr std::array<Action, knownActions.size()> table{{
    still(0, true),
    walk(1, fast, 0, 0),
    walk(2, 0, turning, 0),
    walk(3, 0, -turning, 0),
    kick(4, rightKick),
    kick(5, leftKick),
    walk(6, 0, 0, sidle),
    walk(7, 0, 0, -sidle),
    walk(8, slow, 0, 0),
    walk(9, 0, -turning, aroundBall),
    still(10, false),
    still(11, true),
    kick(12, passLeft),
    kick(13, passRight),
    walk(14, 0, turning, -aroundBall),
    still(15, false),
    still(16, false),
    walk(17, -fast, 0, 0),
    walk(18, -slow, 0, 0),
    still(19, false),
    still(20, false),
    kick(21, weak(rightKick), false),
    kick(22, weak(leftKick), false),
}};

constexpr bool isMadeAsItsKind(const Action& action) {
  const bool moves = action.front != 0 || action.turn != 0 || action.drift != 0;
  return moves == (action.kind == ActionKind::Walk) &&
         (action.kick.strength > 0) == (action.kind == ActionKind::Kick);
}

static_assert([] {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].code != static_cast<int>(i) || !isMadeAsItsKind(table[i])) return false;
  }
  return true;
}());

}  // namespace

const Action* findAction(int code) {
  const bool known = code >= 0 && code < static_cast<int>(table.size());
  return known ? &table[static_cast<std::size_t>(code)] : nullptr;
}

}  // namespace pitchboard::sim
