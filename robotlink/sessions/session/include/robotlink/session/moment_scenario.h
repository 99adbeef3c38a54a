// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a scenario from any frame, whether live, recorded or simulated, so that a match can start
// from it. Plain values; any thread.

#include <string>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

struct MomentOptions {
  enum class Poses : std::uint8_t { True, Believed };
  enum class Ball : std::uint8_t { True, Perceived };
  Poses poses = Poses::True;  ///< believed poses are used where the truth is unknown
  Ball ball = Ball::True;     ///< the perceived ball is used if the truth is unknown
  /// The behaviour of robots whose behaviour is unknown. A name of behaviours(), or noBehaviour.
  std::string behaviour = "striker";
  /// Physics, noise, stop conditions, scripted writes and rules come from this scenario, and so
  /// does the field unless that of the frame has another size. Its game, if any, is that of this
  /// moment; otherwise the game comes from the referee's packet in the frame, in whole seconds.
  const Scenario* base = nullptr;
  /// The catalog of the match that will start. Received blackboards of robots are written there,
  /// except for the variables of the referee.
  const VariableCatalog* catalog = &VariableCatalog::published();
};

struct MomentScenario {
  Scenario scenario;
  /// Sentences about what could not be carried over: "B2 stood outside the walls and was moved
  /// inside."
  std::vector<std::string> notes;
};

/// Always returns a valid scenario: values that no match can have are corrected, and listed in the
/// notes.
MomentScenario scenarioFromMoment(const MatchFrame& frame, const MomentOptions& options = {});

}  // namespace pitchboard::link
