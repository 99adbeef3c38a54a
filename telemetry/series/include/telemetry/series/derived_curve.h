// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Curves that are computed from other curves. Each is an object that takes one sample after another
// in order of time, so that a live curve continues where it was; derived() runs one over a whole
// curve. A NaN sample is a gap: it gives NaN, and the next samples are computed as if it had not
// been there. Plain values, not thread-safe; only MovingAverage allocates.

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <telemetry/series/series_statistics.h>

namespace pitchboard::telemetry {

/// Change per second since the previous sample: (v − v₋₁) / (t − t₋₁). NaN for the first sample,
/// and for one at the same time as the previous one, which it then replaces.
class Derivative {
 public:
  Sample next(const Sample& sample);

 private:
  std::optional<Sample> m_before;
};

/// Integral by the trapezoid rule, 0 at the first sample. Its unit is that of the values times s.
class Integral {
 public:
  Sample next(const Sample& sample);

 private:
  std::optional<Sample> m_before;
  double m_sum = 0.0;
};

/// Mean of the finite samples in (t − window, t]. `window` is in s; if it is not above 0, the
/// values are passed on unchanged.
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

/// Wraps an angle into (−half, half]: half is 180 for degrees, π for radians.
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

/// A conversion that the menu of a curve offers.
struct UnitConversion {
  std::string_view to;  ///< as in ColumnInfo::unit
  double factor = 1.0;
};
/// Returns the units into which `unit` can be converted: between cm and m, ° and rad, 0.1 V and V,
/// ms, µs and s.
std::vector<UnitConversion> unitConversionsFrom(std::string_view unit);

/// Applies one of the curves above to all samples.
template <class Curve>
std::vector<Sample> derived(std::span<const Sample> samples, Curve curve) {
  std::vector<Sample> out;
  out.reserve(samples.size());
  for (const Sample& sample : samples) out.push_back(curve.next(sample));
  return out;
}

/// Returns the statistics of the finite values in the closed interval. `samples` are in order of
/// time.
SeriesStatistics statisticsOf(std::span<const Sample> samples, TimeRange range);

}  // namespace pitchboard::telemetry
