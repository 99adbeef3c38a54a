// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tails and quantiles of probability distributions, as statistics text books name them. Any thread;
// pure functions. The one user of Boost.Math, whose headers are expensive to compile.

#include <cstddef>

namespace pitchboard::link {

/// P(Z <= z) of the standard normal distribution.
double normalCdf(double z);
/// The z with P(Z <= z) = `p`, for p in (0, 1).
double normalQuantile(double p);

/// The x with P(X <= x) = `p` of the chi-squared distribution, for `freedom` > 0 and p in (0, 1).
double chiSquaredQuantile(double freedom, double p);

/// P(T > t) of Student's t distribution with `freedom` > 0 degrees of freedom.
double studentTail(double freedom, double t);
/// The t with P(T > t) = `tail`, for tail in (0, 1).
double studentUpperQuantile(double freedom, double tail);

/// Clopper-Pearson bounds of a rate, each missed with probability `tail`.
struct RateBounds {
  double low = 0.0, high = 1.0;
};
RateBounds clopperPearson(double successes, double trials, double tail);

/// Numbers of successes among `drawn` of `all`, of which `successes` are successes, without
/// replacement (hypergeometric distribution).
struct DrawnSuccesses {
  std::size_t successes = 0, drawn = 0, all = 0;
  /// P(X = x).
  double probability(std::size_t x) const;
  /// P(X <= x).
  double upTo(std::size_t x) const;
  /// P(X > x).
  double above(std::size_t x) const;
};

}  // namespace pitchboard::link
