// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The file of `pitchboard-cli learn` (docs/learning.md): which parameters of a team are searched,
// by which objective, against which opponents, for how long, and how the result is validated. Each
// step is a tournament, with its rules for matches, seeds and sides. Numbers have the units of the
// file. Plain values; any thread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <robotlink/experiment/experiment.h>

namespace pitchboard::link {

/// A parameter that all behaviours of the team share.
struct LearnedParameter {
  std::string key, unit;
  double from = 0.0, to = 1.0;  ///< the search stays between these
  double start = 0.5;
  // Convert between values and shares of the range, 0 to 1: logarithmic if both ends are positive,
  // otherwise linear. Values are rounded to six significant digits, so that all computers try the
  // same ones.
  double at(double share) const;
  double shareOf(double value) const;
  bool operator==(const LearnedParameter&) const = default;
};

struct Learning {
  std::string name = "untitled";
  std::string objective = "goals - goals_against";  ///< over a match's metrics; larger is better
  std::vector<LearnedParameter> parameters;
  std::size_t matches = 20;  ///< of each candidate against each opponent in a generation
  bool swapSides = true;
  std::size_t population = 16, generations = 30;
  double sigma = 0.2;
  std::uint32_t seed = 1;
  /// Candidates of the final choice: means of the last generations, and best points. Each plays
  /// `choosingMatches` against each opponent.
  std::size_t lastMeans = 8, bestPoints = 3, choosingMatches = 60;
  std::size_t validationMatches = 200;  ///< against each opponent
  std::string text;                     ///< the file with its scenario inside
  /// Tournaments (JSON) whose first team is the one that learns.
  std::string training, validation;
};

/// Errors name file, line and key; those of teams, scenario and stop only the key.
Result<Learning> loadLearning(const std::string& path);
/// Paths of scenarios in the text are relative to `folder`.
Result<Learning> learningFromJson(std::string_view text, std::string_view source,
                                  const std::string& folder = {});

/// The team with these parameters.
struct Candidate {
  std::string name;
  std::vector<double> values;  ///< by parameter
};

/// The seeds of training, choosing and validation never overlap.
inline constexpr std::uint64_t firstTrainingSeed = 1'000'000, firstChoosingSeed = 2'000'000,
                               firstValidationSeed = 9'000'000;

/// Returns a tournament of all candidates against all opponents with the same seeds. The pairs of
/// the first candidate come first.
Result<Experiment> trainingOf(const Learning& learning, const std::string& name,
                              std::span<const Candidate> candidates, std::size_t matches,
                              std::uint64_t seed);
Result<Experiment> validationOf(const Learning& learning, const Candidate& winner);

}  // namespace pitchboard::link
