// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_extreme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pitchboard::ui {

std::optional<double> extremeTime(const telemetry::GroupView& group, std::uint32_t column,
                                  telemetry::TimeRange range, Extreme which) {
  const double sign = which == Extreme::Maximum ? 1.0 : -1.0;
  constexpr std::size_t fewRows = 2000;
  std::vector<telemetry::Sample> samples;
  // The part in which it lies, again and again, until there are few enough rows to look at each.
  for (double width = range.end - range.begin;; width = range.end - range.begin) {
    samples.clear();
    if (group.samples(column, range, samples, fewRows) || !(width > 1e-6)) break;
    std::array<telemetry::SeriesBucket, 64> parts{};
    group.buckets(column, {range.begin, std::nextafter(range.end, range.end + 1.0)}, parts);
    std::size_t best = parts.size();
    const auto height = [&](std::size_t i) {
      return which == Extreme::Maximum ? parts[i].max : -parts[i].min;
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].samples == 0 || std::isnan(height(i))) continue;
      if (best == parts.size() || height(i) > height(best)) best = i;
    }
    if (best == parts.size()) return {};
    const double part = width / static_cast<double>(parts.size());
    const double begin = range.begin + part * static_cast<double>(best);
    range = {begin, std::min(range.end, begin + part)};
  }
  const telemetry::Sample* found = nullptr;
  for (const telemetry::Sample& one : samples) {
    if (std::isfinite(one.value) && (found == nullptr || sign * one.value > sign * found->value))
      found = &one;
  }
  return found ? std::optional(found->time) : std::nullopt;
}

}  // namespace pitchboard::ui
