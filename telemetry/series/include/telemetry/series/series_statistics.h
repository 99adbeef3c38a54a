// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Mean, minimum, maximum, standard deviation and root mean square of many values in one pass. Each
// block is summed relative to its first value, and blocks are combined by the formula of Chan,
// Golub and LeVeque (Updating Formulae and a Pairwise Algorithm for Computing Sample Variances,
// 1979), so that a large offset costs no precision. Values that are not finite are ignored. Plain
// value; not thread-safe.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <telemetry/series/series_store.h>

namespace pitchboard::telemetry {

class StatisticsSum {
 public:
  template <class T>
  void add(const T* values, std::size_t count) {
    double shift = 0.0, sum = 0.0, squares = 0.0, low = 0.0, high = 0.0;
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = static_cast<double>(values[i]);
      if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(value)) continue;
      }
      if (n++ == 0) shift = low = high = value;
      const double off = value - shift;
      sum += off;
      squares += off * off;
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
    if (n == 0) return;
    const double mean = sum / static_cast<double>(n);
    join(n, shift + mean, squares - sum * mean, low, high);
  }
  /// Adds the same value `count` times.
  void addEqual(double value, std::uint64_t count) {
    if (std::isfinite(value) && count > 0) join(count, value, 0.0, value, value);
  }

  SeriesStatistics result() const {
    SeriesStatistics out;
    out.samples = m_count;
    if (m_count == 0) return out;
    const double variance = std::fmax(0.0, m_squares / static_cast<double>(m_count));
    out.mean = m_mean;
    out.min = m_min;
    out.max = m_max;
    out.sigma = std::sqrt(variance);
    out.rms = std::hypot(m_mean, out.sigma);  // mean of squares = square of mean + variance
    return out;
  }

 private:
  void join(std::uint64_t count, double mean, double squares, double low, double high) {
    const auto a = static_cast<double>(m_count), b = static_cast<double>(count);
    const double off = mean - m_mean;
    m_min = m_count == 0 || low < m_min ? low : m_min;
    m_max = m_count == 0 || high > m_max ? high : m_max;
    m_mean = m_count == 0 ? mean : m_mean + off * (b / (a + b));
    m_squares += squares + (m_count == 0 ? 0.0 : off * off * (a * b / (a + b)));
    m_count += count;
  }

  std::uint64_t m_count = 0;
  double m_mean = 0.0, m_squares = 0.0, m_min = 0.0, m_max = 0.0;  // squares: around the mean
};

}  // namespace pitchboard::telemetry
