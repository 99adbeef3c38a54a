// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an advisor has learned of the opponents: how likely each of a few models of them is. Three
// things are unknown: how their keeper moves, at which side of the goal they aim, and how fast they
// walk. Each has a list of hypotheses with a prior and the evidence for it: the logarithm of the
// likelihood of everything seen so far. Evidence is kept in whole thousandths, so that it has the
// same value in memory, on the blackboard and in a file. Everything is from the opponents' point of
// view (left and right are theirs, their goal is at -x), so that it stays true when the teams
// change sides. Metres, m/s. Plain values; any thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

struct KeeperModel {
  bool follows = true;  ///< the ball; false: it stays
  double aside = 0.0;   ///< BehaviourParameters::keeperAside
  /// Those of a keeper that is otherwise like `base`.
  BehaviourParameters numbers(const BehaviourParameters& base = {}) const;
};

inline constexpr std::size_t keeperModels = 10, aimModels = 7, paceModels = 7;
KeeperModel keeperModel(std::size_t i);
/// BehaviourParameters::aimSide.
double aimModel(std::size_t i);
/// Speed as a share of that of the robot that thinks.
double paceModel(std::size_t i);

/// Evidence for each of a few hypotheses, and what follows from it.
template <std::size_t N>
struct Evidence {
  /// How much less likely each is than the best, in thousandths of the natural logarithm.
  std::array<std::uint16_t, N> behind{};
  bool operator==(const Evidence&) const = default;

  /// After another observation, whose likelihood under hypothesis i has the logarithm `logs[i]`.
  void add(const std::array<double, N>& logs);
};

struct OpponentModel {
  Evidence<keeperModels> keeper;
  Evidence<aimModels> aim;
  Evidence<paceModels> pace;
  bool operator==(const OpponentModel&) const = default;

  static constexpr std::size_t words = (keeperModels + aimModels + paceModels) / 2;
  /// Two numbers of 16 bits in each word.
  std::array<std::int32_t, words> asWords() const;
  /// Numbers that add() cannot have made are taken for the largest.
  static OpponentModel fromWords(const std::array<std::int32_t, words>& all);

  // Probabilities, in the order of the hypotheses.
  std::vector<double> keeperShares() const;
  std::vector<double> aimShares() const;
  std::vector<double> paceShares() const;
  /// How sure it is that they aim at a part of the goal of their own: 0 as before anything was
  /// learned, or less sure; 1 certainly.
  double aimsUnusually() const;
  /// 0: nothing was learned; else 100 k + 10 a + p, the most likely keeper, aim and pace, from 1
  /// (the keeper from 1 to 10).
  int summary() const;
};

/// Their keeper stood at `place` while the ball was at `ball`.
void learnKeeper(OpponentModel& model, const sim::FieldSpec& field, const Point& place,
                 const Point& ball);
/// A ball that an opponent had rolled from `from` to `to`. Says something only if it rolled forward
/// and from where a kick reaches the goal.
void learnAim(OpponentModel& model, const sim::FieldSpec& field, const Point& from,
              const Point& to);
/// An opponent moved this fast on average, as a share of `full` m/s; `sigma` of the same unit.
void learnPace(OpponentModel& model, double share, double sigma);

}  // namespace pitchboard::link
