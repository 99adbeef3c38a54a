// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/statistics/curve_statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <telemetry/series/series_statistics.h>
#include <telemetry/series/series_summary.h>
#include <telemetry/statistics/distributions.h>
#include <telemetry/statistics/quantile.h>

#include "correlation.h"

namespace pitchboard::telemetry {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double tailOf95 = 0.025;
constexpr std::uint64_t minPairs = 10;
/// More even times than this are not needed for a delay, and would fill the memory.
constexpr std::size_t maxEvenTimes = std::size_t{1} << 20;
/// Longer series are transformed block by block, and up to this lag (an hour and more at 60 Hz).
constexpr std::size_t maxLag = std::size_t{1} << 18, blockLength = std::size_t{1} << 19;

/// A sample variance of less than this part of the mean's square is what rounding leaves.
bool isConstant(const SeriesStatistics& of) {
  return !(of.sigma > 1e-12 * std::abs(of.mean)) || of.min == of.max;
}

SeriesStatistics momentsOf(std::span<const double> values) {
  StatisticsSum sum;
  sum.add(values.data(), values.size());
  return sum.result();
}

double deviationOf(const SeriesStatistics& of) {
  if (of.samples < 2) return unknown;
  const auto n = static_cast<double>(of.samples);
  return of.sigma * std::sqrt(n / (n - 1.0));
}

std::vector<double> valuesOf(std::span<const Sample> samples) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& sample : samples) values.push_back(sample.value);
  return values;
}

/// The sum over i of values[i] * values[i + lag] for each lag from 0 to `most`.
std::vector<double> ownProducts(std::span<const double> values, std::size_t most) {
  std::vector<double> out(most + 1, 0.0);
  for (std::size_t begin = 0; begin < values.size(); begin += blockLength) {
    const auto rest = values.subspan(begin);
    const auto sums = shiftedProducts(rest.first(std::min(rest.size(), blockLength)),
                                      rest.first(std::min(rest.size(), blockLength + most)), most);
    for (std::size_t lag = 0; lag <= most; ++lag) out[lag] += sums[most + lag];
  }
  return out;
}

/// Without the unknown samples at both ends, which have no neighbours to be like.
std::span<const double> withoutEnds(std::span<const double> values) {
  const auto isKnown = [](double value) { return std::isfinite(value); };
  const auto first = std::find_if(values.begin(), values.end(), isKnown);
  const auto last = std::find_if(values.rbegin(), values.rend(), isKnown).base();
  if (first >= last) return {};
  return values.subspan(static_cast<std::size_t>(first - values.begin()),
                        static_cast<std::size_t>(last - first));
}

}  // namespace

double effectiveSamples(std::span<const double> given) {
  const std::span<const double> values = withoutEnds(given);
  const SeriesStatistics moments = momentsOf(values);
  const auto known = static_cast<double>(moments.samples);
  if (moments.samples < 4 || isConstant(moments)) return known;
  const std::size_t length = values.size();
  std::vector<double> centred(length, 0.0), there(length, 0.0);
  for (std::size_t i = 0; i < length; ++i) {
    if (!std::isfinite(values[i])) continue;
    centred[i] = values[i] - moments.mean;
    there[i] = 1.0;
  }
  const bool isWhole = moments.samples == length;
  const std::size_t most = std::min(length - 1, maxLag);
  const std::vector<double> products = ownProducts(centred, most);
  const std::vector<double> counts = isWhole ? std::vector<double>() : ownProducts(there, most);
  const auto all = static_cast<double>(length);
  const double variance = products[0] / known;
  // `weight`: the share of the pairs of this lag that are known, against that of the samples.
  struct Lag {
    double correlation = 0.0, weight = 0.0;
  };
  const auto at = [&](std::size_t lag) {
    const double possible = all - static_cast<double>(lag);
    const double pairs = isWhole ? possible : std::round(counts[lag]);
    if (pairs < 1.0) return Lag{};
    return Lag{products[lag] / (pairs * variance), pairs / possible * (all / known)};
  };
  // The sum of the correlations, and of what is missing in each because the samples' own mean was
  // taken away instead of the true one: (1 - correlation) / effective samples.
  double sum = 0.0, missing = 0.0;
  for (std::size_t lag = 0; lag + 1 <= most; lag += 2) {
    const Lag even = at(lag), odd = at(lag + 1);
    if (even.correlation + odd.correlation <= 0.0) break;
    sum += even.weight * even.correlation + odd.weight * odd.correlation;
    missing += even.weight * (1.0 - even.correlation) + odd.weight * (1.0 - odd.correlation);
  }
  const double rest = 1.0 - 2.0 * missing / known;
  const double time = 2.0 * sum - at(0).weight;  // in samples; lag 0 counts once
  if (!(rest > 0.0)) return 1.0;
  return time > 0.0 ? std::clamp(known * rest / time, 1.0, known) : known;
}

MeanInterval intervalOfMean(std::span<const double> values) {
  const SeriesStatistics moments = momentsOf(values);
  MeanInterval out{effectiveSamples(values), unknown, unknown};
  if (out.effective < 2.0 || moments.samples < 2) return out;
  const double n = out.effective;
  // The variance around the samples' own mean is too small by the variance of the mean.
  const double error = moments.sigma / std::sqrt(n - 1.0);
  const double half = studentUpperQuantile(n - 1.0, tailOf95) * error;
  out.low = moments.mean - half;
  out.high = moments.mean + half;
  return out;
}

std::vector<double> durationsOf(std::span<const Sample> samples) {
  std::vector<double> out(samples.size(), 1.0);
  if (samples.size() < 2) return out;
  std::vector<double> steps;
  steps.reserve(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    out[i] = std::clamp(samples[i + 1].time - samples[i].time, 0.0, SummaryPart::maxSilence);
    steps.push_back(out[i]);
  }
  std::ranges::sort(steps);
  out.back() = quantile(steps, 0.5);
  return out;
}

CurveSummary summaryOf(std::span<const Sample> samples, const Counted& counted, bool isCode) {
  CurveSummary out;
  const std::vector<double> values = valuesOf(samples);
  const SeriesStatistics moments = momentsOf(values);
  out.samples = moments.samples;
  const std::vector<double> lasting = durationsOf(samples);
  double knownTime = 0.0, time = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    time += lasting[i];
    if (std::isfinite(values[i])) {
      knownTime += lasting[i];
    } else {
      ++out.missing;
    }
  }
  out.share = time > 0.0 ? knownTime / time : unknown;
  out.mean = out.deviation = out.rms = out.meanLow = out.meanHigh = out.least = out.leastAt =
      out.most = out.mostAt = out.effective = unknown;
  out.quantiles.fill(unknown);
  if (moments.samples == 0 || isCode) return out;
  out.mean = moments.mean;
  out.deviation = deviationOf(moments);
  out.rms = moments.rms;
  out.least = moments.min;
  out.most = moments.max;
  const auto timeOf = [&](double value) {
    return samples[static_cast<std::size_t>(std::ranges::find(values, value) - values.begin())]
        .time;
  };
  out.leastAt = timeOf(out.least);
  out.mostAt = timeOf(out.most);
  const MeanInterval interval = intervalOfMean(values);
  out.effective = interval.effective;
  out.meanLow = interval.low;
  out.meanHigh = interval.high;
  std::vector<double> sorted;
  sorted.reserve(moments.samples);
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double value) { return std::isfinite(value); });
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < percentiles.size(); ++i) {
    out.quantiles[i] = quantile(sorted, percentiles[i].share);
  }
  return out;
}

std::optional<std::vector<StateShare>> statesOf(std::span<const Sample> samples, std::size_t most) {
  const std::vector<double> lasting = durationsOf(samples);
  std::map<double, StateShare> states;
  double whole = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double value = samples[i].value;
    if (!std::isfinite(value)) continue;
    StateShare& state = states[value];
    state.value = value;
    state.share += lasting[i];
    ++state.samples;
    whole += lasting[i];
    if (states.size() > most) return {};
  }
  std::vector<StateShare> out;
  for (auto& [value, state] : states) {
    state.share = whole > 0.0 ? state.share / whole : unknown;
    out.push_back(state);
  }
  return out;
}

namespace {

/// The values of a curve at other times: the last one before or at each, at most 10 s old.
class HeldCurve {
 public:
  explicit HeldCurve(std::span<const Sample> samples) : m_samples(samples) {}
  /// `time` must not decrease from call to call.
  double at(double time) {
    while (m_next < m_samples.size() && m_samples[m_next].time <= time) ++m_next;
    if (m_next == 0 || time - m_samples[m_next - 1].time > SummaryPart::maxSilence) return unknown;
    return m_samples[m_next - 1].value;
  }

 private:
  std::span<const Sample> m_samples;
  std::size_t m_next = 0;
};

double medianStep(std::span<const Sample> samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step = samples[i].time - samples[i - 1].time;
    if (step > 0.0) steps.push_back(step);
  }
  std::ranges::sort(steps);
  return quantile(steps, 0.5);
}

/// The sums that Pearson's coefficient of each delay needs.
struct ShiftedSums {
  std::vector<double> pairs, a, b, aa, bb, ab;
};

ShiftedSums sumsOf(const std::vector<double>& a, const std::vector<double>& b, std::size_t most) {
  const auto squares = [](const std::vector<double>& values) {
    std::vector<double> out;
    out.reserve(values.size());
    for (const double value : values) out.push_back(value * value);
    return out;
  };
  const auto parts = [](const std::vector<double>& values) {
    // Values around their mean, 0 where they are unknown; and where they are known.
    std::pair<std::vector<double>, std::vector<double>> out;
    const double mean = momentsOf(values).mean;
    for (const double value : values) {
      const bool isKnown = std::isfinite(value);
      out.first.push_back(isKnown ? value - mean : 0.0);
      out.second.push_back(isKnown ? 1.0 : 0.0);
    }
    return out;
  };
  const auto x = parts(a), y = parts(b);
  return {shiftedProducts(x.second, y.second, most),
          shiftedProducts(x.first, y.second, most),
          shiftedProducts(x.second, y.first, most),
          shiftedProducts(squares(x.first), y.second, most),
          shiftedProducts(x.second, squares(y.first), most),
          shiftedProducts(x.first, y.first, most)};
}

}  // namespace

CurveError errorAgainst(std::span<const Sample> curve, std::span<const Sample> other,
                        const Counted& counted) {
  std::vector<Sample> difference;
  difference.reserve(curve.size());
  HeldCurve held(other);
  for (const Sample& sample : curve) {
    difference.push_back({sample.time, sample.value - held.at(sample.time)});
  }
  const CurveSummary all = summaryOf(difference, counted);
  CurveError out{all.samples,  all.missing, all.mean, all.meanLow,
                 all.meanHigh, all.rms,     unknown,  unknown};
  if (all.samples == 0) return out;
  const bool isBelow = -all.least > all.most;
  out.largest = isBelow ? all.least : all.most;
  out.largestAt = isBelow ? all.leastAt : all.mostAt;
  return out;
}

ValueMap valueMap(std::span<const Sample> curve, std::span<const Sample> x,
                  std::span<const Sample> y, const MapGrid& grid) {
  ValueMap out;
  out.grid = grid;
  const auto squares = static_cast<std::size_t>(std::max(0, grid.columns)) *
                       static_cast<std::size_t>(std::max(0, grid.rows));
  out.means.assign(squares, 0.0);
  out.counts.assign(squares, 0);
  HeldCurve heldX(x), heldY(y);
  for (const Sample& sample : curve) {
    const double column = std::floor((heldX.at(sample.time) - grid.left) / grid.cell);
    const double row = std::floor((heldY.at(sample.time) - grid.bottom) / grid.cell);
    if (!std::isfinite(sample.value) || !std::isfinite(column) || !std::isfinite(row)) continue;
    if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) {
      ++out.outside;
      continue;
    }
    const std::size_t square =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
        static_cast<std::size_t>(column);
    const auto count = static_cast<double>(++out.counts[square]);
    out.means[square] += (sample.value - out.means[square]) / count;
  }
  for (std::size_t i = 0; i < squares; ++i) {
    if (out.counts[i] == 0) out.means[i] = unknown;
  }
  return out;
}

std::optional<CurveCorrelation> correlationOf(std::span<const Sample> curve,
                                              std::span<const Sample> other, double maxDelay) {
  if (curve.size() < minPairs || other.size() < minPairs) return {};
  const double begin = std::min(curve.front().time, other.front().time);
  const double length = std::max(curve.back().time, other.back().time) - begin;
  double step = std::max(medianStep(curve), medianStep(other));
  if (!(step > 0.0) || !(length > 0.0)) return {};
  step = std::max(step, length / static_cast<double>(maxEvenTimes));
  const auto count = static_cast<std::size_t>(std::floor(length / step + 1e-6)) + 1;
  const auto most = std::min(
      static_cast<std::size_t>(std::max(0.0, std::floor(maxDelay / step + 1e-6))), count - 1);
  HeldCurve first(curve), second(other);
  std::vector<double> a, b;
  for (std::size_t i = 0; i < count; ++i) {
    // A little later, so that rounding does not take the sample before.
    const double time = begin + (static_cast<double>(i) + 1e-6) * step;
    a.push_back(first.at(time));
    b.push_back(second.at(time));
  }
  const ShiftedSums sums = sumsOf(a, b, most);
  const double spreadA = momentsOf(a).sigma, spreadB = momentsOf(b).sigma;
  CurveCorrelation out;
  out.step = step;
  out.byDelay.assign(2 * most + 1, unknown);
  out.atZero = out.coefficient = unknown;
  for (std::size_t i = 0; i < out.byDelay.size(); ++i) {
    const double n = std::round(sums.pairs[i]);
    if (n < static_cast<double>(minPairs)) continue;
    const double varianceA = sums.aa[i] / n - std::pow(sums.a[i] / n, 2);
    const double varianceB = sums.bb[i] / n - std::pow(sums.b[i] / n, 2);
    // Smaller is what rounding leaves of no spread.
    if (!(varianceA > 1e-10 * spreadA * spreadA) || !(varianceB > 1e-10 * spreadB * spreadB)) {
      continue;
    }
    const double together = sums.ab[i] / n - sums.a[i] / n * (sums.b[i] / n);
    const double r = std::clamp(together / std::sqrt(varianceA * varianceB), -1.0, 1.0);
    out.byDelay[i] = r;
    if (i == most) out.atZero = r;
    const double delay = (static_cast<double>(i) - static_cast<double>(most)) * step;
    // Of equal ones the shortest delay, as far as rounding tells them apart.
    const bool isNearer = std::abs(delay) < std::abs(out.delay);
    const double gain = std::abs(r) - std::abs(out.coefficient);
    if (std::isnan(out.coefficient) || gain > 1e-12 || (gain > -1e-12 && isNearer)) {
      out.coefficient = r;
      out.delay = delay;
      out.samples = static_cast<std::uint64_t>(n);
    }
  }
  if (std::isnan(out.coefficient)) return {};
  return out;
}

}  // namespace pitchboard::telemetry
