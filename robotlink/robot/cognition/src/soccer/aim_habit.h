// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an advisor has learned of the opponents: at which part of the goal they aim. There are seven
// hypotheses with a prior and the evidence for each: the logarithm of the likelihood of everything
// seen so far, in whole thousandths, so that it has the same value in memory, on the blackboard and
// in a file. Everything is from the opponents' point of view (left and right are theirs, they
// attack towards +x), so that it stays true when the teams change sides. Metres. Plain values; any
// thread.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <base/geometry.h>
#include <base/result.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

struct AimHabit {
  /// The middle of the part of the goal that is aimed at (BehaviourParameters::aimSide).
  static constexpr std::array aims{-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75};
  static constexpr std::size_t words = (aims.size() + 1) / 2;

  /// How much less likely each aim is than the best, in thousandths of the natural logarithm.
  std::array<std::uint16_t, aims.size()> behind{};
  bool operator==(const AimHabit&) const = default;

  /// Adds an observation, whose likelihood under hypothesis i has the logarithm `logs[i]`.
  void add(const std::array<double, aims.size()>& logs);
  /// Adds a ball that an opponent had rolled from `from` to `to`. It says something only if it
  /// rolled forward and from where a kick reaches the goal.
  void addKick(const sim::FieldSpec& field, const Point& from, const Point& to);
  /// Returns the probability of each aim.
  std::array<double, aims.size()> shares() const;
  /// Returns the mean aim, -1 (right post) to 1 (left post); 0 if nothing was learned.
  double meanAim() const;

  /// Two numbers of 16 bits in each word.
  std::array<std::int32_t, words> asWords() const;
  /// Numbers that add() cannot have made are replaced by the largest.
  static AimHabit fromWords(const std::array<std::int32_t, words>& all);
};

/// Returns how far (m, to its left) a keeper should stand beside its usual place.
double keeperShift(const AimHabit& habit, const sim::FieldSpec& field);

// The file in which an advisor keeps it (docs/advisor.md).
std::string habitToJson(const AimHabit& habit);
/// `source` names the text in errors. Files of versions up to 0.22 have more than the aim, which is
/// ignored.
Result<AimHabit> habitFromJson(std::string_view text, std::string_view source);
/// Returns a habit without evidence if there is no such file.
Result<AimHabit> loadHabit(const std::string& path);

}  // namespace pitchboard::link
