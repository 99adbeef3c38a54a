// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The series store done the plain way: every row kept, every query a loop over all of them. What
// the store answers is compared with this.

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <telemetry/series/series_store.h>

namespace pitchboard::telemetry {

struct NaiveRow {
  double time = 0.0;
  std::vector<std::uint32_t> words;
  std::vector<double> values;
};

class NaiveSeries {
 public:
  explicit NaiveSeries(GroupInfo group) : info(std::move(group)) {}

  void append(const NaiveRow& row) {
    if (!rows.empty() && row.time < rows.back().time) {
      std::erase_if(rows, [&](const NaiveRow& r) { return r.time >= row.time; });
    }
    rows.push_back(row);
  }

  double value(std::uint32_t column, const NaiveRow& row) const {
    const ColumnInfo& described = info.columns[column];
    const bool lost = std::ranges::any_of(described.lost, [&](const LostWhen& when) {
      const auto flag = std::ranges::find(info.columns, when.column, &ColumnInfo::name);
      return word(static_cast<std::uint32_t>(flag - info.columns.begin()), row) == when.value;
    });
    return lost ? std::numeric_limits<double>::quiet_NaN() : word(column, row);
  }

  /// As it was appended.
  double word(std::uint32_t column, const NaiveRow& row) const {
    std::size_t words = 0, values = 0;
    for (std::uint32_t c = 0; c < column; ++c) {
      (info.columns[c].type == ColumnType::Float64 ? values : words) += 1;
    }
    switch (info.columns[column].type) {
      case ColumnType::Int32:
        return static_cast<std::int32_t>(row.words[words]);
      case ColumnType::Float32:
        return static_cast<double>(std::bit_cast<float>(row.words[words]));
      case ColumnType::Float64:
        break;
    }
    return row.values[values];
  }

  const NaiveRow* at(double time) const {
    const NaiveRow* found = nullptr;
    for (const NaiveRow& row : rows) {
      if (row.time <= time) found = &row;
    }
    return found;
  }

  std::vector<Sample> samples(std::uint32_t column, TimeRange range) const {
    std::vector<Sample> out;
    for (const NaiveRow& row : rows) {
      if (row.time >= range.begin && row.time <= range.end)
        out.push_back({row.time, value(column, row)});
    }
    return out;
  }

  double lastChange(std::uint32_t column) const {
    std::size_t found = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double a = value(column, rows[i - 1]), b = value(column, rows[i]);
      if (!(a == b || (std::isnan(a) && std::isnan(b)))) found = i;
    }
    return rows[found].time;
  }

  std::vector<SeriesBucket> buckets(std::uint32_t column, TimeRange range,
                                    std::size_t count) const {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<SeriesBucket> out(count, SeriesBucket{nan, nan, nan, nan, 0});
    std::size_t row = 0;
    while (row < rows.size() && rows[row].time < range.begin) ++row;
    for (std::size_t i = 0; i < count; ++i) {
      const double end = std::lerp(range.begin, range.end,
                                   static_cast<double>(i + 1) / static_cast<double>(count));
      SeriesBucket& b = out[i];
      for (; row < rows.size() && rows[row].time < end; ++row) {
        const double v = value(column, rows[row]);
        if (b.samples++ == 0) b.first = v;
        b.last = v;
        if (std::isnan(v)) continue;
        b.min = std::isnan(b.min) ? v : std::min(b.min, v);
        b.max = std::isnan(b.max) ? v : std::max(b.max, v);
      }
    }
    return out;
  }

  SeriesStatistics statistics(std::uint32_t column, TimeRange range) const {
    SeriesStatistics out;
    long double sum = 0, squares = 0;
    std::vector<double> finite;
    for (const Sample& s : samples(column, range)) {
      if (!std::isfinite(s.value)) continue;
      out.min = finite.empty() ? s.value : std::min(out.min, s.value);
      out.max = finite.empty() ? s.value : std::max(out.max, s.value);
      sum += s.value;
      squares += static_cast<long double>(s.value) * s.value;
      finite.push_back(s.value);
    }
    if (finite.empty()) return out;
    const auto n = static_cast<long double>(finite.size());
    const long double mean = sum / n;
    long double around = 0;
    for (const double v : finite) around += (v - mean) * (v - mean);
    out.samples = finite.size();
    out.mean = static_cast<double>(mean);
    out.sigma = static_cast<double>(std::sqrt(around / n));
    out.rms = static_cast<double>(std::sqrt(squares / n));
    return out;
  }

  GroupInfo info;
  std::vector<NaiveRow> rows;
};

}  // namespace pitchboard::telemetry
