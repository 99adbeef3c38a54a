// SPDX-License-Identifier: GPL-3.0-or-later
#include "lookahead.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <robotlink/rollout/summary.h>

#include "game_belief.h"
#include "position_value.h"

namespace pitchboard::link {
namespace {

using rollout::Column;
using Row = std::array<double, rollout::columnCount>;

constexpr double quantile = 2.0;  // of t, 95 % on both sides, for the usual numbers
constexpr double worthIt = 0.01;  // goals
constexpr double least = 0.004;   // goals: standard deviation of the gain of one rollout

double in(const Row& row, Column column) {
  return row[static_cast<std::size_t>(column)];
}

/// Where the rules put a ball that has left the field: a goal kick is taken from the halfway line
/// (2021 to 2024), a corner kick from the corner.
void putBack(const sim::FieldSpec& field, bool oursTouchedIt, Position& end) {
  constexpr double away = 0.75;  // m that the others keep
  end.near = oursTouchedIt ? away : 0.0;
  end.theirsNear = oursTouchedIt ? 0.0 : away;
  const double x = field.halfLength(), y = field.halfWidth();
  if (std::abs(end.ball.x) > x) {
    const bool attackersTouchedIt = oursTouchedIt == (end.ball.x > 0.0);
    end.ball = {attackersTouchedIt ? 0.0 : std::copysign(x, end.ball.x),
                std::copysign(y, end.ball.y)};
  }
}

}  // namespace

LookaheadPlan planFor(Question question, int rollouts, double horizon,
                      const OpponentModel& learned) {
  // A keeper walks for seconds to where it must be when the ball is kicked, and most of its
  // rollouts end alike.
  constexpr int far = 2, looksFar = 12;
  if (question != Question::Keeper) return {rollouts, horizon};
  LookaheadPlan plan{far * rollouts, far * horizon, looksFar};
  // The behaviour is made for the usual opponents. The surer it is that these aim elsewhere, the
  // more another place may gain.
  constexpr double spreadThen = 0.15;  // goals
  const double surely = learned.aimsUnusually();
  plan.usualGain *= 1.0 - surely;
  plan.gainSpread += surely * (spreadThen - plan.gainSpread);
  return plan;
}

double valueOfRow(const Row& row, const sim::FieldSpec& field) {
  const double goals = in(row, Column::GoalsLeft) - in(row, Column::GoalsRight);
  if (goals != 0.0) return goals;
  Position end;
  end.ball = {in(row, Column::BallX), in(row, Column::BallY)};
  end.near = in(row, Column::NearLeft);
  end.theirsNear = in(row, Column::NearRight);
  if (static_cast<rollout::Ended>(static_cast<int>(in(row, Column::EndedBy))) ==
      rollout::Ended::BallOut) {
    // Whoever touched it last has lost it.
    putBack(field, in(row, Column::LastTouch) < static_cast<double>(theirKeeper), end);
  } else {
    end.velocity = {in(row, Column::BallVx), in(row, Column::BallVy)};
  }
  return positionValue(field, end);
}

namespace {

double meanOf(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Lookahead::Lookahead(rollout::Belief belief, const Candidates& candidates, std::uint64_t seed,
                     const LookaheadPlan& plan)
    : m_belief(std::move(belief)), m_candidates(candidates), m_seed(seed), m_plan(plan) {
  for (std::size_t i = 1; i < m_candidates.size(); ++i) m_alive.push_back(i);
  for (std::size_t left = m_alive.size(); left > 2; left = (left + 1) / 2) ++m_rounds;
  planRound();
}

/// Every candidate that is left plays as often; a few times first, because most lookaheads end
/// there.
void Lookahead::planRound() {
  const int players = static_cast<int>(m_alive.size()) + 1;
  const int share = m_round == 0 ? std::min(m_plan.firstLook, m_plan.rollouts / players)
                                 : (m_plan.rollouts - m_played) / (m_rounds - m_round) / players;
  const std::size_t first = m_of[0].values.size();
  const auto count = static_cast<std::size_t>(std::max(2, share));
  m_queue.clear();
  for (std::size_t seed = first + count; seed-- > first;) {
    for (const std::size_t candidate : m_alive) m_queue.push_back({candidate, seed});
    m_queue.push_back({0, seed});
  }
}

/// Who can hardly gain any more plays no further; then the worse half does not.
void Lookahead::halve() {
  std::erase_if(m_alive, [this](std::size_t one) {
    const Gain gain = gainOf(one);
    constexpr double surely = 3.0;  // of t, for the few of the first look
    return gain.mean + surely * gain.error < worthIt;
  });
  if (m_round == 1) return;
  std::ranges::stable_sort(
      m_alive, [this](std::size_t a, std::size_t b) { return valueOf(a) > valueOf(b); });
  m_alive.resize(std::max<std::size_t>(1, (m_alive.size() + 1) / 2));
}

void Lookahead::playOne(rollout::Rollouts& rollouts, const sim::FieldSpec& field) {
  const Next next = m_queue.back();
  m_queue.pop_back();
  rollout::PlayOptions options;
  options.seconds = m_plan.horizon;
  options.look = 5.0;
  options.advice = m_candidates[next.candidate];
  options.advised = ownPlayer;
  Row row{};
  const std::uint64_t seed = m_seed + next.seed;
  Of& of = m_of[next.candidate];
  double value = 0.0;
  if (rollouts.play(m_belief, {&seed, 1}, options, row)) {
    value = valueOfRow(row, field);
    of.goals += in(row, Column::GoalsLeft) > 0.0;
    of.goalsAgainst += in(row, Column::GoalsRight) > 0.0;
    ++of.heat[rollout::heatCell({in(row, Column::LookX), in(row, Column::LookY)}, field,
                                heatColumns, heatRows)];
  }
  of.values.push_back(value);
  ++m_played;
  if (!m_queue.empty() || ++m_round >= m_rounds) return;
  halve();
  if (!m_alive.empty()) planRound();
}

double Lookahead::valueOf(std::size_t candidate) const {
  return meanOf(m_of[candidate].values);
}

/// Over what the behaviour would do, paired by random numbers.
Lookahead::Gain Lookahead::gainOf(std::size_t candidate) const {
  const std::vector<double>&values = m_of[candidate].values, &own = m_of[0].values;
  const std::size_t n = std::min(values.size(), own.size());
  std::vector<double> gains(n);
  for (std::size_t i = 0; i < n; ++i) gains[i] = values[i] - own[i];
  const double mean = meanOf(gains);
  double squares = 0.0;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  const double count = static_cast<double>(n);
  if (n < 2) return {mean, 1.0};
  // A few rollouts that happen to be alike are not sure.
  return {mean, std::max(std::sqrt(squares / (count * (count - 1.0))), least / std::sqrt(count))};
}

/// What a gain is worth that was measured so: the best of a few measured ones looks better than it
/// is. Shrunk towards the usual gain of a candidate.
double Lookahead::expectedGain(const Gain& gain) const {
  const double variance = m_plan.gainSpread * m_plan.gainSpread;
  const double share = variance / (variance + gain.error * gain.error);
  return share * gain.mean + (1.0 - share) * m_plan.usualGain;
}

/// The best is suggested if it is expected to gain.
LookaheadResult Lookahead::result() const {
  LookaheadResult out;
  std::size_t best = 0;
  for (const std::size_t one : m_alive) {
    if (best == 0 || valueOf(one) > valueOf(best)) best = one;
  }
  if (best != 0) {
    const Gain gain = gainOf(best);
    const double low = gain.mean - quantile * gain.error;
    if (expectedGain(gain) > worthIt) {
      out.best = best;
      out.gain = gain.mean;
      out.gainLow = low;
    }
  }
  const Of& of = m_of[out.best];
  const double count = std::max<double>(1.0, static_cast<double>(of.values.size()));
  out.value = valueOf(out.best);
  out.goal = of.goals / count;
  out.goalAgainst = of.goalsAgainst / count;
  return out;
}

}  // namespace pitchboard::link
