// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tail probabilities and quantiles of probability distributions, under the names of statistics text
// books. Only this file uses Boost.Math, because its headers are slow to compile. Pure functions;
// any thread.

#include <cstddef>

namespace pitchboard::telemetry {

/// Returns P(Z <= z) for the standard normal distribution.
double normalCdf(double z);
/// Returns the z with P(Z <= z) = `p`, for p in (0, 1).
double normalQuantile(double p);

/// Returns the x with P(X <= x) = `p` for the chi-squared distribution with `freedom` > 0 degrees
/// of freedom, for p in (0, 1).
double chiSquaredQuantile(double freedom, double p);

/// Returns P(T > t) for Student's t distribution with `freedom` > 0 degrees of freedom.
double studentTail(double freedom, double t);
/// Returns the t with P(T > t) = `tail`, for tail in (0, 1).
double studentUpperQuantile(double freedom, double tail);

/// The Clopper-Pearson confidence interval of a rate. Each bound is wrong with a probability of at
/// most `tail`.
struct RateBounds {
  double low = 0.0, high = 1.0;
};
RateBounds clopperPearson(double successes, double trials, double tail);

/// The number of successes X when `drawn` items are drawn without replacement from `all` items, of
/// which `successes` are successes (hypergeometric distribution).
struct DrawnSuccesses {
  std::size_t successes = 0, drawn = 0, all = 0;
  /// P(X = x).
  double probability(std::size_t x) const;
  /// P(X <= x).
  double upTo(std::size_t x) const;
  /// P(X > x).
  double above(std::size_t x) const;
};

}  // namespace pitchboard::telemetry
