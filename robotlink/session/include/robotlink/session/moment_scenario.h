// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From a moment to a simulation: whatever frame a person looks at (live, recorded, simulated)
// becomes a scenario that starts from it.

#include <string>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

struct MomentOptions {
  enum class Poses : std::uint8_t { True, Believed };
  enum class Ball : std::uint8_t { True, Perceived };
  Poses poses = Poses::True;  ///< Believed is taken where the truth is not known
  Ball ball = Ball::True;     ///< Perceived likewise
  /// Given to robots whose own is not known (live ones). A name of behaviours(), or noBehaviour.
  std::string behaviour = "striker";
  /// Physics, noise, stop conditions and scripted writes are taken over from here; the field too,
  /// unless the frame has one of another size.
  const Scenario* base = nullptr;
  /// The map of the match that will start: what robots had on received blackboards is written
  /// there, but for the referee's words.
  const VariableCatalog* catalog = &VariableCatalog::published();
};

struct MomentScenario {
  Scenario scenario;
  /// What could not be taken over as it was, in sentences: "B2 stood outside the walls and was
  /// moved inside." Empty: nothing.
  std::vector<std::string> notes;
};

/// Always a scenario that a match can be made of: numbers that no match has are corrected and
/// noted.
MomentScenario scenarioFromMoment(const MatchFrame& frame, const MomentOptions& options = {});

}  // namespace pitchboard::link
