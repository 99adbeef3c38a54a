// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <telemetry/statistics/distributions.h>
#include <telemetry/statistics/quantile.h>

namespace pitchboard::link {
namespace {

constexpr double tail = 0.025;  // of each side of a 95 % interval
constexpr std::size_t resamples = 2000;
// More values than this: draws are what takes the time, and fewer resamples say the same.
constexpr std::size_t maxDraws = 4'000'000;
constexpr std::size_t minResamples = 200;
/// A smaller part of the mean is what is left of rounding, not spread.
constexpr double minSpread = 1e-9;
/// In pooled deviations: from here on, what differs is rather how little the runs vary.
constexpr double suspiciousEffect = 10.0;

std::vector<double> finite(std::span<const double> values) {
  std::vector<double> out;
  out.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double value) { return std::isfinite(value); });
  return out;
}

/// A number below `limit` from 32 random bits; its bias (limit / 2^32) is far below what counts.
std::size_t below(std::uint32_t bits, std::size_t limit) {
  return static_cast<std::size_t>((std::uint64_t{bits} * limit) >> 32U);
}

std::size_t successesOf(const SampleMoments& rate) {
  const double n = static_cast<double>(rate.count);
  return static_cast<std::size_t>(std::clamp(std::round(rate.mean * n), 0.0, n));
}

bool hasSpread(const SampleMoments& sample) {
  return sample.deviation > minSpread * std::abs(sample.mean);
}

/// Wilson's score interval.
Interval scoreInterval(const SampleMoments& rate) {
  static const double z = telemetry::normalQuantile(1.0 - tail);
  const double n = static_cast<double>(rate.count), p = rate.mean;
  const double middle = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {(middle - half) / (1.0 + z * z / n), (middle + half) / (1.0 + z * z / n)};
}

Interval differenceOfRates(const SampleMoments& a, const SampleMoments& b) {
  const Interval ofA = scoreInterval(a), ofB = scoreInterval(b);
  const double difference = a.mean - b.mean;
  return {difference - std::hypot(a.mean - ofA.low, ofB.high - b.mean),
          difference + std::hypot(ofA.high - a.mean, b.mean - ofB.low)};
}

}  // namespace

SampleMoments momentsOf(std::span<const double> values) {
  SampleMoments out;
  double squares = 0.0;  // Welford's update
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++out.count;
    const double off = value - out.mean;
    out.mean += off / static_cast<double>(out.count);
    squares += off * (value - out.mean);
  }
  if (out.count == 0) out.mean = std::numeric_limits<double>::quiet_NaN();
  if (out.count > 1) out.deviation = std::sqrt(squares / static_cast<double>(out.count - 1));
  return out;
}

std::optional<Interval> intervalOfMean(std::span<const double> all) {
  const std::vector<double> values = finite(all);
  if (values.size() < 2) return {};
  const auto [least, most] = std::ranges::minmax_element(values);
  if (*least == *most) return Interval{*least, *least};
  const std::size_t count = std::clamp(maxDraws / values.size(), minResamples, resamples);
  std::mt19937 random(20180611);
  std::vector<double> means(count);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += values[below(static_cast<std::uint32_t>(random()), values.size())];
    }
    mean = sum / static_cast<double>(values.size());
  }
  std::ranges::sort(means);
  return Interval{telemetry::quantile(means, tail), telemetry::quantile(means, 1.0 - tail)};
}

std::optional<Interval> intervalOfRate(const SampleMoments& rate) {
  if (rate.count < 2) return {};
  const telemetry::RateBounds bounds = telemetry::clopperPearson(
      static_cast<double>(successesOf(rate)), static_cast<double>(rate.count), tail);
  return Interval{bounds.low, bounds.high};
}

Summary summaryOf(std::span<const double> all, bool rate) {
  Summary out;
  out.moments = momentsOf(all);
  std::vector<double> values = finite(all);
  std::ranges::sort(values);
  out.least = telemetry::quantile(values, 0.0);
  out.lowerQuartile = telemetry::quantile(values, 0.25);
  out.median = telemetry::quantile(values, 0.5);
  out.upperQuartile = telemetry::quantile(values, 0.75);
  out.p95 = telemetry::quantile(values, 0.95);
  out.most = telemetry::quantile(values, 1.0);
  out.mean95 = rate ? intervalOfRate(out.moments) : intervalOfMean(all);
  return out;
}

std::optional<WelchTest> welchTest(const SampleMoments& a, const SampleMoments& b) {
  if (a.count < 2 || b.count < 2 || !hasSpread(a) || !hasSpread(b)) return {};
  const double na = static_cast<double>(a.count), nb = static_cast<double>(b.count);
  const double va = a.deviation * a.deviation / na, vb = b.deviation * b.deviation / nb;
  if (!std::isfinite(va + vb)) return {};
  WelchTest out;
  out.difference = a.mean - b.mean;
  const double error = std::sqrt(va + vb);
  out.t = out.difference / error;
  out.freedom = (va + vb) * (va + vb) / (va * va / (na - 1.0) + vb * vb / (nb - 1.0));
  out.p = std::min(1.0, 2.0 * telemetry::studentTail(out.freedom, std::abs(out.t)));
  out.criticalOne = telemetry::studentUpperQuantile(out.freedom, 2.0 * tail);
  out.criticalTwo = telemetry::studentUpperQuantile(out.freedom, tail);
  out.difference95 = {out.difference - out.criticalTwo * error,
                      out.difference + out.criticalTwo * error};
  const double pooled =
      std::sqrt(((na - 1.0) * a.deviation * a.deviation + (nb - 1.0) * b.deviation * b.deviation) /
                (na + nb - 2.0));
  // Hedges, Distribution theory for Glass's estimator of effect size (1981).
  const double small = 1.0 - 3.0 / (4.0 * (na + nb) - 9.0);
  out.hedgesG = pooled > 0.0 ? small * out.difference / pooled : 0.0;
  return out;
}

double fisherTest(std::size_t successesA, std::size_t a, std::size_t successesB, std::size_t b) {
  const std::size_t successes = successesA + successesB, all = a + b;
  const std::size_t least = successes + a > all ? successes + a - all : 0;
  const std::size_t most = std::min(successes, a);
  if (least == most) return 1.0;
  const telemetry::DrawnSuccesses tables{successes, a, all};
  // Equal probabilities may differ by rounding: R and scipy allow for that, too.
  const double limit = tables.probability(successesA) * (1.0 + 1e-7);
  const auto rare = [&](std::size_t x) { return tables.probability(x) <= limit; };
  // Probabilities rise to the mode and fall behind it.
  std::size_t mode = (successes + 1) * (a + 1) / (all + 2);
  mode = std::clamp(mode, least, most);
  if (rare(mode)) return 1.0;
  const auto firstOf = [](std::size_t from, std::size_t to, const auto& holds) {
    while (from < to) {
      const std::size_t middle = from + (to - from) / 2;
      if (holds(middle)) {
        to = middle;
      } else {
        from = middle + 1;
      }
    }
    return from;
  };
  const std::size_t low = firstOf(least, mode, [&](std::size_t x) { return !rare(x); });
  const std::size_t high = firstOf(mode + 1, most + 1, rare);
  double p = 0.0;
  if (low > least) p += tables.upTo(low - 1);
  if (high <= most) p += tables.above(high - 1);
  return std::min(1.0, p);
}

Comparison compared(const SampleMoments& a, const SampleMoments& b, bool rate) {
  Comparison out;
  out.difference = a.mean - b.mean;
  if (a.count < 2 || b.count < 2) {
    out.note = "too few values for a test";
  } else if (rate) {
    out.test = Comparison::Test::Fisher;
    out.p = fisherTest(successesOf(a), a.count, successesOf(b), b.count);
    out.difference95 = differenceOfRates(a, b);
  } else if (std::isnan(a.deviation) || std::isnan(b.deviation)) {
    out.note = "no spread given, so no test";
  } else if (out.welch = welchTest(a, b); out.welch) {
    out.test = Comparison::Test::Welch;
    out.p = out.welch->p;
    out.difference95 = out.welch->difference95;
    if (std::abs(out.welch->hedgesG) > suspiciousEffect) {
      out.note = "the runs hardly vary: add noise or other starts";
    }
  } else {
    out.note = hasSpread(a) || hasSpread(b) ? "one side has no spread, so no test"
                                            : "neither side has spread, so no test";
  }
  return out;
}

std::string Comparison::testText() const {
  if (test == Test::Fisher) return "Fisher";
  if (test == Test::None) return note;
  return note[0] == '\0' ? "Welch" : std::string("Welch; ") + note;
}

PairedDifference pairedDifference(std::span<const double> a, std::span<const double> b) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i])) differences.push_back(a[i] - b[i]);
  }
  PairedDifference out;
  out.pairs = differences.size();
  out.mean = momentsOf(differences).mean;
  // Equal pairs say nothing of how far they might differ.
  const bool vary =
      std::ranges::any_of(differences, [&](double one) { return one != differences.front(); });
  if (vary) out.mean95 = intervalOfMean(differences);
  return out;
}

}  // namespace pitchboard::link
