// SPDX-License-Identifier: GPL-3.0-or-later
#include "opponent_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <base/repeatable_math.h>
#include <robotlink/cognition/keeper_place.h>

namespace pitchboard::link {
namespace {

// Whoever is as far behind is still remembered when the opponents change what they do.
constexpr std::uint16_t mostBehind = 12000;
constexpr double unit = 0.001;

constexpr std::array asides{-0.8, -0.4, 0.0, 0.4, 0.8};               // m
constexpr std::array aims{-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75};  // share of half a goal
constexpr std::array paces{0.5, 0.65, 0.8, 1.0, 1.2, 1.4, 1.6};
static_assert(2 * asides.size() == keeperModels && aims.size() == aimModels &&
              paces.size() == paceModels);

// Before anything was seen: robots like our own, and all peculiarities alike.
constexpr double usualShare = 0.5;
constexpr std::size_t usualKeeper = 2, usualAim = 3, usualPace = 3;

constexpr double root2Pi = 2.5066282746310002;

double density(double x, double mean, double sigma) {
  const double z = (x - mean) / sigma;
  return repeatable::exp(-0.5 * z * z) / (sigma * root2Pi);
}

/// Share of a normal distribution below z, nearly.
double below(double z) {
  return 1.0 / (1.0 + repeatable::exp(-1.702 * z));
}

template <std::size_t N>
std::vector<double> sharesOf(const Evidence<N>& evidence, std::size_t usual) {
  std::vector<double> shares(N);
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    const double prior = i == usual ? usualShare : (1.0 - usualShare) / (N - 1);
    shares[i] = prior * repeatable::exp(-unit * evidence.behind[i]);
    sum += shares[i];
  }
  for (double& share : shares) share /= sum;
  return shares;
}

int mostLikely(const std::vector<double>& shares) {
  return static_cast<int>(std::ranges::max_element(shares) - shares.begin());
}

}  // namespace

BehaviourParameters KeeperModel::numbers(const BehaviourParameters& base) const {
  BehaviourParameters out = base;
  if (!follows) out.keeperArc = 0.0;
  out.keeperAside = aside;
  return out;
}

KeeperModel keeperModel(std::size_t i) {
  return {i < asides.size(), asides[i % asides.size()]};
}

double aimModel(std::size_t i) {
  return aims[i];
}

double paceModel(std::size_t i) {
  return paces[i];
}

template <std::size_t N>
void Evidence<N>::add(const std::array<double, N>& logs) {
  std::array<double, N> all{};
  for (std::size_t i = 0; i < N; ++i) all[i] = logs[i] - unit * behind[i];
  const double best = *std::ranges::max_element(all);
  for (std::size_t i = 0; i < N; ++i) {
    const double lost = std::min<double>((best - all[i]) / unit, mostBehind);
    behind[i] = static_cast<std::uint16_t>(std::lround(lost));
  }
}
template struct Evidence<keeperModels>;
template struct Evidence<aimModels>;  // of pace, too
static_assert(paceModels == aimModels);

std::array<std::int32_t, OpponentModel::words> OpponentModel::asWords() const {
  std::array<std::int32_t, words> out{};
  std::size_t at = 0;
  const auto put = [&](std::uint16_t number) {
    const std::uint32_t bits = static_cast<std::uint32_t>(number) << (16 * (at % 2));
    out[at / 2] = static_cast<std::int32_t>(static_cast<std::uint32_t>(out[at / 2]) | bits);
    ++at;
  };
  std::ranges::for_each(keeper.behind, put);
  std::ranges::for_each(aim.behind, put);
  std::ranges::for_each(pace.behind, put);
  return out;
}

OpponentModel OpponentModel::fromWords(const std::array<std::int32_t, words>& all) {
  OpponentModel out;
  std::size_t at = 0;
  const auto take = [&](std::uint16_t& number) {
    const auto bits = static_cast<std::uint32_t>(all[at / 2]) >> (16 * (at % 2));
    number = std::min(static_cast<std::uint16_t>(bits & 0xffffU), mostBehind);
    ++at;
  };
  std::ranges::for_each(out.keeper.behind, take);
  std::ranges::for_each(out.aim.behind, take);
  std::ranges::for_each(out.pace.behind, take);
  return out;
}

std::vector<double> OpponentModel::keeperShares() const {
  return sharesOf(keeper, usualKeeper);
}
std::vector<double> OpponentModel::aimShares() const {
  return sharesOf(aim, usualAim);
}
std::vector<double> OpponentModel::paceShares() const {
  return sharesOf(pace, usualPace);
}

double OpponentModel::aimsUnusually() const {
  return std::max(0.0, 1.0 - aimShares()[usualAim] / usualShare);
}

int OpponentModel::summary() const {
  if (*this == OpponentModel{}) return 0;
  return 100 * (mostLikely(keeperShares()) + 1) + 10 * (mostLikely(aimShares()) + 1) +
         mostLikely(paceShares()) + 1;
}

void learnKeeper(OpponentModel& model, const sim::FieldSpec& field, const Point& place,
                 const Point& ball) {
  // It comes late where it wants to be, and neither it nor the one that looks knows exactly where
  // it stands.
  constexpr double late = 0.3;       // m
  constexpr double elsewhere = 0.2;  // of the looks it does something else
  std::array<double, keeperModels> logs{};
  for (std::size_t i = 0; i < keeperModels; ++i) {
    const double stands = keeperPlace(field, keeperModel(i).numbers(), ball).position.y;
    logs[i] = repeatable::log((1.0 - elsewhere) * density(place.y, stands, late) +
                              elsewhere / field.goalWidth);
  }
  model.keeper.add(logs);
}

void learnAim(OpponentModel& model, const sim::FieldSpec& field, const Point& from,
              const Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  constexpr double forward = 0.5;  // m per metre
  if (dx < forward * length(Point{dx, dy})) return;
  const double left = field.halfLength() - from.x;
  constexpr double far = 4.0;  // m: from there nobody aims at the goal
  if (left <= 0.0 || left > far) return;
  const double y = from.y + left * dy / dx;  // where it crosses their opponents' goal line
  const double half = field.goalWidth / 2 - field.goalPostRadius - field.ballRadius;
  constexpr double error = 0.1;      // rad: kick, and the ways that were seen
  constexpr double spread = 0.4;     // of half of the part of the goal
  constexpr double elsewhere = 0.2;  // of the balls roll by chance, or as a pass
  std::array<double, aimModels> logs{};
  for (std::size_t i = 0; i < aimModels; ++i) {
    const double middle = aims[i] * half, part = half * (1.0 - std::abs(aims[i]));
    const double sigma = repeatable::hypot(spread * part, error * left);
    logs[i] =
        repeatable::log((1.0 - elsewhere) * density(y, middle, sigma) + elsewhere / field.width);
  }
  model.aim.add(logs);
}

void learnPace(OpponentModel& model, double share, double sigma) {
  // One that hardly moves stands, turns or waits, however fast it is.
  constexpr double moves = 0.25;
  if (share < moves) return;
  // It goes somewhere, with turns, or does something between. As the kid-size robots of matches
  // come forward: over four seconds little more than half of what their gait could.
  constexpr double straight = 0.6, walksAt = 0.57, spread = 0.2;
  constexpr double other = 0.02;   // density of what the rest of the sum does not explain
  constexpr double weight = 0.25;  // walks of one robot are much alike
  std::array<double, paceModels> logs{};
  for (std::size_t i = 0; i < paceModels; ++i) {
    const double full = paces[i];
    const double between = (below((full - share) / sigma) - below((moves - share) / sigma)) /
                           std::max(sigma, full - moves);
    logs[i] = weight * repeatable::log(straight * density(share, walksAt * full,
                                                          repeatable::hypot(sigma, spread * full)) +
                                       (1.0 - straight) * std::max(0.0, between) + other);
  }
  model.pace.add(logs);
}

}  // namespace pitchboard::link
