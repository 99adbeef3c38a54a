// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Describes a stretch of a curve: moments, percentiles, shares of the time, and how sure the mean
// is although neighbouring samples are alike. A NaN sample is unknown: it is counted as missing and
// enters nothing else. Samples can be left out, because they are not of the stretch; those around
// them then still know that they are not neighbours. docs/statistics.md has the formulas and their
// sources. Pure functions; any thread. Times are s, values in the unit of the curve.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <telemetry/series/series_store.h>

namespace pitchboard::telemetry {

/// The percentiles of a CurveSummary, with the names that tables and files give them.
struct Percentile {
  std::string_view name;
  double share;
};
inline constexpr std::array<Percentile, 5> percentiles{
    {{"p05", 0.05}, {"p25", 0.25}, {"median", 0.5}, {"p75", 0.75}, {"p95", 0.95}}};

/// What is unknown is NaN: everything but the counts without a sample, the deviation of a single
/// one.
struct CurveSummary {
  std::uint64_t samples = 0;  ///< that are known
  std::uint64_t missing = 0;  ///< that are unknown
  double share = 0.0;         ///< of the time in which the value is known
  double mean = 0.0;
  double deviation = 0.0;                ///< with divisor n - 1
  double rms = 0.0;                      ///< root of the mean square
  double effective = 0.0;                ///< effectiveSamples()
  double meanLow = 0.0, meanHigh = 0.0;  ///< 95 % confidence interval of the mean
  double least = 0.0, leastAt = 0.0;     ///< the first smallest value, and its time
  double most = 0.0, mostAt = 0.0;       ///< the first largest value, and its time
  std::array<double, percentiles.size()> quantiles{};
};

/// Which samples count; all if empty. Those that do not count must have the value NaN.
using Counted = std::vector<bool>;

/// Describes samples that are in order of time. `isCode`: values are codes, of which no mean, no
/// deviation, no percentiles and no extremes exist.
CurveSummary summaryOf(std::span<const Sample> samples, const Counted& counted = {},
                       bool isCode = false);

/// How many independent samples would say as much about the mean as these, which follow each other
/// at even steps; from 1 to their number. Unknown samples (NaN) keep their place in the order. 0
/// without a known sample.
double effectiveSamples(std::span<const double> values);

/// The 95 % confidence interval of a mean.
struct MeanInterval {
  double effective = 0.0;        ///< effectiveSamples()
  double low = 0.0, high = 0.0;  ///< NaN if fewer than two samples are effective
};
/// Returns the interval of Student's distribution for the effective samples.
MeanInterval intervalOfMean(std::span<const double> values);

/// How long each sample counts, in s: until the next one, but at most 10 s, after which a curve has
/// a gap; the last one as long as the median of the others, or 1 s if there is no other.
std::vector<double> durationsOf(std::span<const Sample> samples);

/// One value of a code, and how much of the known time it lasted.
struct StateShare {
  double value = 0.0;
  double share = 0.0;
  std::uint64_t samples = 0;
};
/// Returns the values that occur, in ascending order; nothing if there are more than `most`.
std::optional<std::vector<StateShare>> statesOf(std::span<const Sample> samples,
                                                std::size_t most = 1000);

/// How far a curve is off another one.
struct CurveError {
  std::uint64_t samples = 0;  ///< of the curve, at which both are known
  std::uint64_t missing = 0;
  double bias = 0.0;                      ///< mean of curve - other
  double biasLow = 0.0, biasHigh = 0.0;   ///< its 95 % confidence interval
  double rms = 0.0;                       ///< root of the mean square of the difference
  double largest = 0.0, largestAt = 0.0;  ///< the difference of the largest amount, and its time
};
/// Compares at the samples of `curve`; the other one has its last value before or at that time, at
/// most 10 s old.
CurveError errorAgainst(std::span<const Sample> curve, std::span<const Sample> other,
                        const Counted& counted = {});

/// How alike two curves are, and by how much the other one comes later.
struct CurveCorrelation {
  std::uint64_t samples = 0;      ///< pairs at the delay
  double step = 0.0;              ///< s between the even times at which both are compared
  double atZero = 0.0;            ///< Pearson's coefficient without a delay
  double delay = 0.0;             ///< s at which the coefficient has the largest amount
  double coefficient = 0.0;       ///< there
  std::vector<double> byDelay{};  ///< coefficients from -maxDelay to +maxDelay in steps of `step`
};
/// Correlates at all delays up to `maxDelay` (s). A positive delay: the other curve repeats later
/// what this one does. Nothing if fewer than ten pairs are known, or a curve does not vary.
std::optional<CurveCorrelation> correlationOf(std::span<const Sample> curve,
                                              std::span<const Sample> other, double maxDelay);

/// Equal squares of a plane, from the lower left corner; all lengths in m.
struct MapGrid {
  double left = 0.0, bottom = 0.0;
  double cell = 0.25;  ///< side of a square
  int columns = 0, rows = 0;
};
/// A value by place.
struct ValueMap {
  MapGrid grid{};
  std::vector<double> means{};          ///< rows from below, squares from left to right; or NaN
  std::vector<std::uint64_t> counts{};  ///< known samples of each square
  std::uint64_t outside = 0;            ///< known samples at places that are not on the map
};
/// Averages the known samples of `curve` in the square in which `x` and `y` (m) were then: their
/// last value before or at that time, at most 10 s old. Samples at unknown places do not count.
ValueMap valueMap(std::span<const Sample> curve, std::span<const Sample> x,
                  std::span<const Sample> y, const MapGrid& grid);

}  // namespace pitchboard::telemetry
