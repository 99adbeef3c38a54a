// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Statistics for experiments: summaries with 95 % confidence intervals, and comparisons of two
// samples. Means are compared by Welch's t-test with an effect size, rates by Fisher's exact test.
// Distributions come from Boost.Math. Values that are not finite are ignored. Pure functions; the
// bootstrap has its own random numbers, so that equal values give equal results. Any thread.

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

/// Mean, standard deviation and size of a sample, ours or a published one.
struct SampleMoments {
  double mean = 0.0;
  double deviation = 0.0;  ///< with divisor n - 1; 0 for a single value
  std::size_t count = 0;
  bool operator==(const SampleMoments&) const = default;
};
SampleMoments momentsOf(std::span<const double> values);

/// Returns the 95 % confidence interval of the mean by the percentile bootstrap. If all values are
/// equal, both ends are that value. Empty for fewer than two values.
std::optional<Interval> intervalOfMean(std::span<const double> values);

/// Returns the 95 % confidence interval of a rate, whose values are 0 or 1: the exact interval of
/// Clopper and Pearson (1934). Empty for fewer than two values.
std::optional<Interval> intervalOfRate(const SampleMoments& rate);

struct Summary {
  SampleMoments moments;
  double least = 0.0, lowerQuartile = 0.0, median = 0.0, upperQuartile = 0.0, p95 = 0.0, most = 0.0;
  std::optional<Interval> mean95;
};
/// Without any value, the count is 0 and everything else is NaN. `rate` means that all values are 0
/// or 1.
Summary summaryOf(std::span<const double> values, bool rate = false);

/// Welch's t-test for the means of two samples with different variances (Welch, The generalization
/// of Student's problem, 1947). The difference is a - b.
struct WelchTest {
  double difference = 0.0;
  Interval difference95;
  double t = 0.0, freedom = 0.0;
  double p = 1.0;            ///< two-tailed
  double criticalOne = 0.0;  ///< |t| at p = 5 %, one-tailed
  double criticalTwo = 0.0;  ///< |t| at p = 5 %, two-tailed
  double hedgesG = 0.0;      ///< effect size: difference in pooled deviations, for small samples
};
/// Empty if a sample has fewer than two values or no spread.
std::optional<WelchTest> welchTest(const SampleMoments& a, const SampleMoments& b);

/// Returns p of Fisher's exact test, two-sided, for the hypothesis that two rates are equal: the
/// sum of the probabilities of all tables with the same margins that are at most as probable as
/// this one (as fisher.test in R and fisher_exact in scipy).
double fisherTest(std::size_t successesA, std::size_t a, std::size_t successesB, std::size_t b);

/// The comparison of two samples.
struct Comparison {
  enum class Test : std::uint8_t { None, Welch, Fisher };
  double difference = 0.0;               ///< of the means, a - b
  std::optional<Interval> difference95;  ///< for rates: Newcombe's hybrid score (1998, method 10)
  Test test = Test::None;
  double p = 1.0;                  ///< two-sided; 1 without a test
  std::optional<WelchTest> welch;  ///< for means
  const char* note = "";           ///< why there is no test, or a warning
  /// Returns the test and the note, for tables.
  std::string testText() const;
};
/// Compares means, or rates if `rate`. A deviation of NaN means that it is unknown.
Comparison compared(const SampleMoments& a, const SampleMoments& b, bool rate);

/// The mean difference of pairs of runs (with the same seed in two conditions), with its interval.
struct PairedDifference {
  std::size_t pairs = 0;
  double mean = 0.0;
  std::optional<Interval> mean95;
};
/// `a` and `b` must have the same size. Pairs in which a value is not finite are ignored.
PairedDifference pairedDifference(std::span<const double> a, std::span<const double> b);

}  // namespace pitchboard::link
