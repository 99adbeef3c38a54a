// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The statistics of experiments: summaries with 95 % intervals, and the comparison of two samples:
// Welch's t-test and an effect size for means, Fisher's exact test for rates.
// Distributions are Boost.Math's. Values that are not finite are left out. Pure functions; the
// bootstrap draws from a generator of its own, so that the same values give the same bits.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pitchboard::link {

struct Interval {
  double low = 0.0, high = 0.0;
  bool operator==(const Interval&) const = default;
};

/// What is known of a sample, ours or a published one.
struct SampleMoments {
  double mean = 0.0;
  double deviation = 0.0;  ///< with n - 1; 0 for one value
  std::size_t count = 0;
  bool operator==(const SampleMoments&) const = default;
};
SampleMoments momentsOf(std::span<const double> values);

/// 95 % of the mean: percentile bootstrap; where all values are equal, that value. Nothing for
/// fewer than two values.
std::optional<Interval> intervalOfMean(std::span<const double> values);

/// 95 % of a rate, whose values are 0 or 1: the exact interval of Clopper and Pearson (1934).
/// Nothing for fewer than two values.
std::optional<Interval> intervalOfRate(const SampleMoments& rate);

struct Summary {
  SampleMoments moments;
  double least = 0.0, lowerQuartile = 0.0, median = 0.0, upperQuartile = 0.0, p95 = 0.0, most = 0.0;
  std::optional<Interval> mean95;
};
/// Everything is NaN, and the count 0, without a value. `rate`: the values are 0 or 1.
Summary summaryOf(std::span<const double> values, bool rate = false);

/// Welch, The generalization of Student's problem (1947): means of two samples whose variances may
/// differ. The difference is a - b.
struct WelchTest {
  double difference = 0.0;
  Interval difference95;
  double t = 0.0, freedom = 0.0;
  double p = 1.0;            ///< two-tailed
  double criticalOne = 0.0;  ///< |t| of p = 5 %, one-tailed
  double criticalTwo = 0.0;  ///< two-tailed
  double hedgesG = 0.0;      ///< difference in pooled deviations, corrected for small samples
};
/// Nothing where a sample has fewer than two values or no spread.
std::optional<WelchTest> welchTest(const SampleMoments& a, const SampleMoments& b);

/// Fisher's exact test that two rates are equal, two-sided: the sum of the probabilities of all
/// tables with the same margins that are at most as probable as this one (as fisher.test of R and
/// fisher_exact of scipy).
double fisherTest(std::size_t successesA, std::size_t a, std::size_t successesB, std::size_t b);

/// What two samples say of each other.
struct Comparison {
  enum class Test : std::uint8_t { None, Welch, Fisher };
  double difference = 0.0;               ///< of the means, a - b
  std::optional<Interval> difference95;  ///< of rates: Newcombe's hybrid score (1998, method 10)
  Test test = Test::None;
  double p = 1.0;                  ///< two-sided; 1 without a test
  std::optional<WelchTest> welch;  ///< of means
  const char* note = "";           ///< why there is no test, or what to beware of
  /// For tables: "Welch", "Fisher", and the note.
  std::string testText() const;
};
/// `rate`: the values are 0 or 1. A deviation that is NaN was not given.
Comparison compared(const SampleMoments& a, const SampleMoments& b, bool rate);

/// The mean of the differences of pairs (the same seed in two conditions), with its interval.
struct PairedDifference {
  std::size_t pairs = 0;
  double mean = 0.0;
  std::optional<Interval> mean95;
};
/// `a` and `b` have the same size; pairs of which one is not finite are left out.
PairedDifference pairedDifference(std::span<const double> a, std::span<const double> b);

/// Counts of equal bins from `low` to `high`, both included.
std::vector<std::size_t> histogram(std::span<const double> values, double low, double high,
                                   std::size_t bins);

}  // namespace pitchboard::link
