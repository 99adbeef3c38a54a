// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The suggestion of an advisor to the decision process of its robot, and the variables that hold it
// on the blackboard (ADVISOR_*, docs/advisor.md). Metres and radians in the studio's frame; on the
// blackboard centimetres and degrees in the frame of LOCALIZATION_*. Plain values; one thread at a
// time.

#include <array>
#include <cstddef>

#include <base/geometry.h>
#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

/// The values of ADVISOR_CHOICE, described in resources/variables.json.
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

/// Returns whether `Advice::place` is a target for the ball.
constexpr bool isForBall(AdviceKind kind) {
  return kind == AdviceKind::StrongKick || kind == AdviceKind::WeakKick ||
         kind == AdviceKind::Dribble;
}

/// The values of ADVISOR_STATE, described in resources/variables.json.
enum class AdvisorState : int { Off = 0, NothingToDecide = 1, Thinks = 2, TooLittleKnown = 3 };

inline constexpr std::size_t mostCandidates = 6;
inline constexpr int heatColumns = 16, heatRows = 10, heatWords = 20;
inline constexpr std::size_t learnedWords = 12;

/// The variables of an advisor. Their index is -1 if the map does not contain them.
struct AdvisorVariables {
  explicit AdvisorVariables(const VariableCatalog& catalog = VariableCatalog::extended());

  IntVar stamp, state, choice, rollouts, candidates, opponent;
  FloatVar x, y, theta, value, gain, gainLow, goal, goalAgainst;
  std::array<IntVar, mostCandidates> candidate;
  std::array<FloatVar, mostCandidates> candidateValue;
  std::array<IntVar, heatWords> heat;
  std::array<IntVar, learnedWords> learned;  ///< what the advisor knows of the opponents

  /// Reads the current advice; AdviceKind::None if the numbers are not valid.
  Advice read(const Blackboard& board, const sim::FieldSpec& field) const;
  void write(Blackboard& board, const sim::FieldSpec& field, const Advice& advice) const;
  /// Returns the advice as a value of ADVISOR_CANDIDATEn.
  static int packed(const sim::FieldSpec& field, const Advice& advice);
};

}  // namespace pitchboard::link
