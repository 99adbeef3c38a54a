// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <limits>

#include <telemetry/series/series_statistics.h>

#include "series_view_search.h"

namespace pitchboard::telemetry::series {

void View::buckets(std::uint32_t column, TimeRange range, std::span<SeriesBucket> out) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const SeriesBucket empty{nan, nan, nan, nan, 0};
  std::ranges::fill(out, empty);
  const auto slot = slotOf(column);
  if (m_rows == 0 || !slot || out.empty() || !(range.begin < range.end) ||
      !std::isfinite(range.begin) || !std::isfinite(range.end)) {
    return;
  }
  withType(m_state->layout->slots[*slot].type, [&](auto zero) {
    using T = decltype(zero);
    const auto border = [&, parts = static_cast<double>(out.size())](std::size_t i) {
      return std::lerp(range.begin, range.end, static_cast<double>(i) / parts);
    };
    const std::size_t start = Search<false>(*this, range.begin).unit;
    Ahead far{*this, *slot, start}, near{*this, *slot, start};
    Search<false> search(*this, range.begin);
    std::size_t begin = search(range.begin);
    for (std::size_t i = 0; i < out.size(); ++i) {
      far.wantTimes(border(i + 16));
      near.wantValues<T>(border(i + 8));
      const std::size_t end = search(border(i + 1));
      if (end == begin) continue;
      SeriesBucket& bucket = out[i];
      bucket.samples = static_cast<std::uint32_t>(
          std::min<std::size_t>(end - begin, std::numeric_limits<std::uint32_t>::max()));
      bucket.first = static_cast<double>(value<T>(*slot, begin));
      bucket.last = static_cast<double>(value<T>(*slot, end - 1));
      MinMax<T> found;
      minMax<T>(*slot, begin, end, found);
      if (found.any()) {
        bucket.min = static_cast<double>(found.min);
        bucket.max = static_cast<double>(found.max);
      }
      begin = end;
    }
  });
}

bool View::samples(std::uint32_t column, TimeRange range, std::vector<Sample>& out,
                   std::size_t most) const {
  out.clear();
  const auto slot = slotOf(column);
  if (!slot || !(range.begin <= range.end)) return true;
  const std::size_t begin = Search<false>(*this, range.begin)(range.begin);
  const std::size_t end = Search<true>(*this, range.end)(range.end);
  if (begin >= end) return true;
  const std::size_t taken = std::min(end - begin, most);
  out.reserve(taken);
  withType(m_state->layout->slots[*slot].type, [&](auto zero) {
    using T = decltype(zero);
    runs<T>(*slot, begin, begin + taken,
            [&](const double* times, const T* values, T constant, std::uint32_t count) {
              for (std::uint32_t i = 0; i < count; ++i) {
                out.push_back({times[i], static_cast<double>(values ? values[i] : constant)});
              }
              return true;
            });
  });
  return taken == end - begin;
}

SeriesStatistics View::statistics(std::uint32_t column, TimeRange range) const {
  StatisticsSum sum;
  const auto slot = slotOf(column);
  if (!slot || !(range.begin <= range.end)) return sum.result();
  const std::size_t begin = Search<false>(*this, range.begin)(range.begin);
  const std::size_t end = Search<true>(*this, range.end)(range.end);
  withType(m_state->layout->slots[*slot].type, [&](auto zero) {
    using T = decltype(zero);
    runs<T>(*slot, begin, end,
            [&](const double*, const T* values, T constant, std::uint32_t count) {
              if (values)
                sum.add(values, count);
              else
                sum.addEqual(static_cast<double>(constant), count);
              return true;
            });
  });
  return sum.result();
}

}  // namespace pitchboard::telemetry::series
