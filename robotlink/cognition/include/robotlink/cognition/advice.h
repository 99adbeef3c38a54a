// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an advisor suggests to the decision process of its robot, and where that stands on the
// blackboard (ADVISOR_*, docs/advisor.md). Metres and radians, the studio's frame; centimetres and
// degrees of the LOCALIZATION frame on the blackboard. Plain values; any thread, one at a time.

#include <array>
#include <cstddef>

#include <base/geometry.h>
#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

/// ADVISOR_CHOICE; its labels are in resources/variables.json.
enum class AdviceKind : int {
  None = 0,        ///< the behaviour decides
  StrongKick = 1,  ///< to `place`
  WeakKick = 2,    ///< to `place`, also with the side of the foot
  Dribble = 3,     ///< towards `place`
  GoToBall = 4,
  LeaveBall = 5,  ///< to a team-mate
  Stand = 6       ///< at `place`, when the robot does not go for the ball
};
constexpr AdviceKind lastOf(AdviceKind) {
  return AdviceKind::Stand;
}

struct Advice {
  AdviceKind kind = AdviceKind::None;
  Pose place;
  bool operator==(const Advice&) const = default;
};

/// A place where the ball is to go.
constexpr bool isForBall(AdviceKind kind) {
  return kind == AdviceKind::StrongKick || kind == AdviceKind::WeakKick ||
         kind == AdviceKind::Dribble;
}

/// ADVISOR_STATE; its labels are in resources/variables.json.
enum class AdvisorState : int { Off = 0, NothingToDecide = 1, Thinks = 2, KnowsTooLittle = 3 };

inline constexpr std::size_t mostCandidates = 6;
inline constexpr int heatColumns = 16, heatRows = 10, heatWords = 20;

/// The variables of an advisor; of a map without them the index is -1.
struct AdvisorVariables {
  explicit AdvisorVariables(const VariableCatalog& catalog = VariableCatalog::extended());

  IntVar stamp, state, choice, rollouts, candidates, opponent;
  FloatVar x, y, theta, value, gain, gainLow, goal, goalAgainst;
  std::array<IntVar, mostCandidates> candidate;
  std::array<FloatVar, mostCandidates> candidateValue;
  std::array<IntVar, heatWords> heat;

  /// What is suggested now; AdviceKind::None when the numbers make no sense.
  Advice read(const Blackboard& board, const sim::FieldSpec& field) const;
  void write(Blackboard& board, const sim::FieldSpec& field, const Advice& advice) const;
  /// As ADVISOR_CANDIDATEn holds it.
  static int packed(const sim::FieldSpec& field, const Advice& advice);
};

}  // namespace pitchboard::link
