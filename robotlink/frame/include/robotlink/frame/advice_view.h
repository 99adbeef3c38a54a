// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's advisor thinks, as it is shown: read from the ADVISOR_ variables of its blackboard
// (docs/blackboard.md), whatever the source. Plain values in metres, in the studio's frame; any
// thread.

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <robotlink/cognition/advice.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

/// Where the ball may be, in cells of the field. Only the ratios of the numbers count.
struct BallHeat {
  int columns = 0, rows = 0;
  std::vector<float> cells;  ///< rows from below, cells from left to right
  bool operator==(const BallHeat&) const = default;
};

/// An action that the advisor has considered.
struct AdviceCandidate {
  AdviceKind kind = AdviceKind::None;  ///< None: what the behaviour would do
  Point place;                         ///< target of the ball or of the robot
  double value = 0.0;                  ///< expected goal difference
  bool isChosen = false;
  bool operator==(const AdviceCandidate&) const = default;
};

struct AdviceView {
  bool isThinking = false;  ///< false: the advice below is old, and nothing depends on it now
  AdviceKind choice = AdviceKind::None;  ///< None: the behaviour decides
  double value = 0.0;                    ///< expected goal difference of the choice
  double gain = 0.0;                     ///< over what the behaviour would reach by itself
  double goal = 0.0, goalAgainst = 0.0;  ///< shares of the rollouts
  int rollouts = 0;
  std::vector<AdviceCandidate> candidates;
  std::shared_ptr<const BallHeat> heat;  ///< of the ball in 5 s; null: none
};

/// Returns the text of a kind for people: "strong kick".
std::string_view adviceText(AdviceKind kind);

inline constexpr std::size_t adviceVariableCount = 9 + 2 * mostCandidates + heatWords;
/// The variables that readAdvice() needs. Sources look up their places once.
const std::array<std::string_view, adviceVariableCount>& adviceVariables();

/// Returns the value of a variable by its index in adviceVariables(); nothing if the source does
/// not have it.
using AdviceReader = std::function<std::optional<double>(std::size_t variable)>;

/// Returns null if there is no advisor, or it has not thought yet. Numbers that make no sense are
/// left out.
std::shared_ptr<const AdviceView> readAdvice(const AdviceReader& reader,
                                             const sim::FieldSpec& field);

}  // namespace pitchboard::link
