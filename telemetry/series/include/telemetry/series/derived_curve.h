// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Curves made of other curves, and statistics of any samples. Each is an object that takes one
// sample after another in order of time, so that a live curve goes on where it was; derived() runs
// one over a whole curve. A sample whose value is NaN is a hole: it gives NaN and what follows goes
// on as if it had not been there. Not thread-safe; no allocation per sample but in MovingAverage.

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <telemetry/series/series_statistics.h>

namespace pitchboard::telemetry {

/// Change per second since the sample before: (v − v₋₁) / (t − t₋₁). The first sample has none, nor
/// has one at the same time as the one before (it then counts as the one before): NaN.
class Derivative {
 public:
  Sample next(const Sample& sample);

 private:
  std::optional<Sample> m_before;
};

/// Of the values joined by straight lines (trapezoid rule), from 0 at the first sample; unit · s.
class Integral {
 public:
  Sample next(const Sample& sample);

 private:
  std::optional<Sample> m_before;
  double m_sum = 0.0;
};

/// Mean of the samples in (t − window, t]; values that are not finite are left out. `window` in s,
/// above 0; otherwise the values pass unchanged.
class MovingAverage {
 public:
  explicit MovingAverage(double window) : m_window(window) {}
  Sample next(const Sample& sample);

 private:
  double m_window;
  std::deque<Sample> m_samples;  // the finite ones in the window
  // Summed with Neumaier's correction, because every value is added and taken away again.
  double m_sum = 0.0, m_correction = 0.0;
  void add(double value);
};

/// Into (−half, half]: half = 180 for degrees, π for radians. An angle that ran away comes back.
class WrapAngle {
 public:
  explicit WrapAngle(double half) : m_half(half) {}
  Sample next(const Sample& sample) const;

 private:
  double m_half;
};

/// factor · v + offset.
struct LinearConversion {
  double factor = 1.0, offset = 0.0;
  Sample next(const Sample& sample) const { return {sample.time, factor * sample.value + offset}; }
};

/// A conversion that a menu can offer.
struct UnitConversion {
  std::string_view to;  ///< as in ColumnInfo::unit
  double factor = 1.0;
};
/// Of values in `unit`: between cm and m, ° and rad, tenths of a volt and V, ms, µs and s.
std::vector<UnitConversion> unitConversionsFrom(std::string_view unit);

/// Any of the above over a whole curve.
template <class Curve>
std::vector<Sample> derived(std::span<const Sample> samples, Curve curve) {
  std::vector<Sample> out;
  out.reserve(samples.size());
  for (const Sample& sample : samples) out.push_back(curve.next(sample));
  return out;
}

/// Of the finite values in the closed interval; samples in order of time.
SeriesStatistics statisticsOf(std::span<const Sample> samples, TimeRange range);

}  // namespace pitchboard::telemetry
