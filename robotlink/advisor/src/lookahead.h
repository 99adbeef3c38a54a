// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Compares the candidates of one decision with rollouts, by sequential halving; rollout j of each
// candidate has the same random numbers. A plain value: a copy continues as the original does.
// Metres, seconds; one thread.

#include <array>
#include <cstdint>
#include <vector>

#include <robotlink/rollout/rollouts.h>

#include "candidates.h"
#include "opponent_model.h"

namespace pitchboard::link {

/// How a question is answered.
struct LookaheadPlan {
  int rollouts = 72;     ///< in all
  double horizon = 5.0;  ///< s that each of them plays
  int firstLook = 4;     ///< rollouts of each candidate before any is dropped
  // Gains of candidates in goals, before any rollout. Those against the usual opponents are the
  // numbers with which advice lost least in 1 600 questions (advice_gains in tests/benchmarks).
  double usualGain = -0.02;
  double gainSpread = 0.03;  ///< standard deviation
};
/// `rollouts` and `horizon`: of an AdvisorOptions. `learned`: what is known of the opponents.
LookaheadPlan planFor(Question question, int rollouts, double horizon,
                      const OpponentModel& learned);

/// The result.
struct LookaheadResult {
  std::size_t best = 0;  ///< candidate that is suggested; 0: as the behaviour would
  double value = 0.0;    ///< expected goal difference of it
  double gain = 0.0, gainLow = 0.0;
  double goal = 0.0, goalAgainst = 0.0;  ///< shares of its rollouts
};

/// What a rollout is worth: its goals, else the position at its end.
double valueOfRow(const std::array<double, rollout::columnCount>& row, const sim::FieldSpec& field);

class Lookahead {
 public:
  using Heat = std::array<int, static_cast<std::size_t>(heatColumns* heatRows)>;

  Lookahead(rollout::Belief belief, const Candidates& candidates, std::uint64_t seed,
            const LookaheadPlan& plan);

  bool isDone() const { return m_queue.empty(); }
  int played() const { return m_played; }
  /// Plays one more rollout; not when it is done.
  void playOne(rollout::Rollouts& rollouts, const sim::FieldSpec& field);

  const Candidates& candidates() const { return m_candidates; }
  /// Mean value of a candidate so far.
  double valueOf(std::size_t candidate) const;
  LookaheadResult result() const;
  /// Rollouts of a candidate with the ball in a cell after PlayOptions::look.
  const Heat& heat(std::size_t candidate) const { return m_of[candidate].heat; }

 private:
  struct Of {
    std::vector<double> values;  ///< of seed j
    int goals = 0, goalsAgainst = 0;
    Heat heat{};
  };
  struct Next {
    std::size_t candidate = 0, seed = 0;
  };
  struct Gain {
    double mean = 0.0, error = 1.0;  ///< goals; the standard error
  };
  Gain gainOf(std::size_t candidate) const;
  double expectedGain(const Gain& gain) const;
  void planRound();
  void halve();

  rollout::Belief m_belief;
  Candidates m_candidates;
  std::array<Of, mostCandidates> m_of;
  std::uint64_t m_seed = 1;
  LookaheadPlan m_plan;
  int m_played = 0, m_rounds = 2, m_round = 0;
  std::vector<std::size_t> m_alive;  ///< without the first, which always plays
  std::vector<Next> m_queue;         ///< of this round, the next at the back
};

}  // namespace pitchboard::link
