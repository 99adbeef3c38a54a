// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A one-dimensional posterior on a grid: log-weights at equally spaced places of a transformed
// scale, and its quantiles. For numbers whose likelihood is not normal: rates, thresholds, values
// that are known to one tick. Private to calibrate; pure.

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

namespace pitchboard::link {

/// log(sum(exp(one))) without overflow; `logs` is not empty.
inline double logSumExp(std::span<const double> logs) {
  const double most = *std::ranges::max_element(logs);
  double sum = 0.0;
  for (const double one : logs) sum += std::exp(one - most);
  return most + std::log(sum);
}

struct GridPosterior {
  double median = 0.0, low = 0.0, high = 0.0;  ///< 50, 2.5 and 97.5 %
  double deviation = 0.0;                      ///< of the transformed scale
};

/// `place`: value at an index of the grid; `logWeight`: of the posterior there, in the measure of
/// the grid.
inline GridPosterior posteriorOn(int count, const std::function<double(int)>& place,
                                 const std::function<double(int)>& logWeight) {
  std::vector<double> weights(static_cast<std::size_t>(count));
  double most = -1e300;
  for (int i = 0; i < count; ++i) {
    weights[static_cast<std::size_t>(i)] = logWeight(i);
    most = std::max(most, weights[static_cast<std::size_t>(i)]);
  }
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int i = 0; i < count; ++i) {
    double& weight = weights[static_cast<std::size_t>(i)];
    weight = std::exp(weight - most);
    sum += weight;
    first += weight * i;
    second += weight * i * i;
  }
  const auto quantile = [&](double share) {
    double so = 0.0;
    for (int i = 0; i < count; ++i) {
      const double weight = weights[static_cast<std::size_t>(i)] / sum;
      if (so + weight >= share) {
        // A cell reaches half a step to either side.
        const double part = weight > 0.0 ? (share - so) / weight - 0.5 : 0.0;
        const int other = std::clamp(part < 0.0 ? i - 1 : i + 1, 0, count - 1);
        return place(i) + std::abs(part) * (place(other) - place(i));
      }
      so += weight;
    }
    return place(count - 1);
  };
  const double mean = first / sum;
  return {quantile(0.5), quantile(0.025), quantile(0.975),
          std::sqrt(std::max(0.0, second / sum - mean * mean))};
}

/// Between equally spaced values (at least three): the parabola through the three that are nearest.
inline double parabolaAt(const std::vector<double>& values, double index) {
  const auto last = static_cast<long>(values.size()) - 2;
  const auto m = static_cast<std::size_t>(std::clamp(std::lround(index), 1L, last));
  const double u = index - static_cast<double>(m);
  const double slope = 0.5 * (values[m + 1] - values[m - 1]);
  const double curve = values[m + 1] - 2.0 * values[m] + values[m - 1];
  return values[m] + slope * u + 0.5 * curve * u * u;
}

/// A positive number with a log-normal prior; `logLikelihood` of the number. `share`: deviation of
/// the posterior as a share of the prior's.
struct PositivePosterior : GridPosterior {
  double share = 1.0;
};
inline PositivePosterior positivePosterior(double median, double sigma,
                                           const std::function<double(double)>& logLikelihood,
                                           int count = 1201) {
  constexpr double reach = 4.0;
  const double step = 2.0 * reach * sigma / (count - 1);
  const auto place = [&](int i) {
    return median * std::exp(-reach * sigma + step * static_cast<double>(i));
  };
  PositivePosterior out;
  static_cast<GridPosterior&>(out) = posteriorOn(count, place, [&](int i) {
    const double z = (-reach * sigma + step * static_cast<double>(i)) / sigma;
    return -0.5 * z * z + logLikelihood(place(i));
  });
  out.share = out.deviation * step / sigma;
  return out;
}

}  // namespace pitchboard::link
