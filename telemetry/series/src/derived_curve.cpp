// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/derived_curve.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <base/units.h>

namespace pitchboard::telemetry {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

using FromTo = std::pair<std::string_view, std::string_view>;
constexpr std::array<FromTo, 10> conversions{{{"cm", "m"},
                                              {"m", "cm"},
                                              {"°", "rad"},
                                              {"rad", "°"},
                                              {"0.1 V", "V"},
                                              {"V", "0.1 V"},
                                              {"µs", "ms"},
                                              {"ms", "s"},
                                              {"s", "ms"},
                                              {"rad/s", "°/s"}}};

/// The first sample after `time`.
std::span<const Sample>::iterator firstAfter(std::span<const Sample> samples, double time) {
  return std::upper_bound(samples.begin(), samples.end(), time,
                          [](double t, const Sample& s) { return t < s.time; });
}

}  // namespace

std::vector<UnitConversion> unitConversionsFrom(std::string_view unit) {
  std::vector<UnitConversion> out;
  for (const auto& [from, to] : conversions) {
    if (from == unit) out.push_back({to, unitFactor(from, to).value()});
  }
  return out;
}

Sample Derivative::next(const Sample& sample) {
  if (std::isnan(sample.value)) return {sample.time, nothing};
  const auto before = std::exchange(m_before, sample);
  if (!before || !(sample.time > before->time)) return {sample.time, nothing};
  return {sample.time, (sample.value - before->value) / (sample.time - before->time)};
}

Sample Integral::next(const Sample& sample) {
  if (std::isnan(sample.value)) return {sample.time, nothing};
  const auto before = std::exchange(m_before, sample);
  if (before) m_sum += 0.5 * (before->value + sample.value) * (sample.time - before->time);
  return {sample.time, m_sum};
}

void MovingAverage::add(double value) {
  const double sum = m_sum + value;
  m_correction +=
      std::abs(m_sum) >= std::abs(value) ? (m_sum - sum) + value : (value - sum) + m_sum;
  m_sum = sum;
}

Sample MovingAverage::next(const Sample& sample) {
  if (!(m_window > 0.0)) return sample;
  while (!m_samples.empty() && m_samples.front().time <= sample.time - m_window) {
    add(-m_samples.front().value);
    m_samples.pop_front();
  }
  if (m_samples.empty()) m_sum = m_correction = 0.0;
  if (std::isfinite(sample.value)) {
    m_samples.push_back(sample);
    add(sample.value);
  }
  if (!std::isfinite(sample.value) || m_samples.empty()) return {sample.time, nothing};
  return {sample.time, (m_sum + m_correction) / static_cast<double>(m_samples.size())};
}

Sample WrapAngle::next(const Sample& sample) const {
  double wrapped = std::remainder(sample.value, 2.0 * m_half);
  if (wrapped <= -m_half) wrapped = m_half;
  return {sample.time, wrapped};
}

SeriesStatistics statisticsOf(std::span<const Sample> samples, TimeRange range) {
  StatisticsSum sum;
  auto from = std::lower_bound(samples.begin(), samples.end(), range.begin,
                               [](const Sample& s, double t) { return s.time < t; });
  const auto end = firstAfter(samples, range.end);
  constexpr std::size_t blockSize = 64;
  std::array<double, blockSize> block{};
  while (from < end) {
    std::size_t count = 0;
    for (; count < blockSize && from < end; ++from) block[count++] = from->value;
    sum.add(block.data(), count);
  }
  return sum.result();
}

}  // namespace pitchboard::telemetry
