// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_summary.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "series_layout.h"

namespace pitchboard::telemetry {
namespace {

constexpr float unset = std::numeric_limits<float>::quiet_NaN();

/// Values of one kind only need one.
void shorten(std::vector<float>& values) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  const bool same = std::all_of(values.begin(), values.end(),
                                [&](float value) { return bits(value) == bits(values.front()); });
  if (same && !values.empty()) values.resize(1);
}

}  // namespace

std::size_t SummaryPart::bytes() const {
  std::size_t sum = sizeof *this + buckets() * (2 * sizeof(double) + sizeof(std::uint32_t));
  for (const Column& column : columns) {
    sum += sizeof column +
           sizeof(float) * (column.min.size() + column.max.size() + column.last.size());
  }
  return sum;
}

std::uint64_t GroupSummary::rows() const {
  std::uint64_t sum = 0;
  for (const SummaryPart& part : parts) {
    for (const std::uint32_t rows : part.rows) sum += rows;
  }
  return sum;
}

std::optional<TimeRange> GroupSummary::range() const {
  if (parts.empty()) return std::nullopt;
  return TimeRange{parts.front().begin.front(), parts.back().end.back()};
}

std::size_t GroupSummary::bytes() const {
  std::size_t sum = sizeof *this;
  for (const SummaryPart& part : parts) sum += part.bytes();
  return sum;
}

SummaryBuilder::SummaryBuilder(const GroupInfo& group) {
  for (const ColumnInfo& column : group.columns) m_types.push_back(column.type);
  for (const series::Losable& one : series::losableColumns(group)) {
    for (const auto& [word, lost] : one.flags) m_losable.push_back({one.column, word, lost});
  }
  m_now.assign(m_types.size(), {unset, unset, unset});
  m_part.columns.resize(m_types.size());
}

std::optional<SummaryPart> SummaryBuilder::add(double time, const RowView& row) {
  if (m_rows == 0) m_begin = time;
  m_end = time;
  const auto isLost = [&](std::size_t column) {
    return std::ranges::any_of(m_losable, [&](const Losable& one) {
      return one.column == column && one.flag < row.words.size() && row.words[one.flag] == one.lost;
    });
  };
  std::size_t word = 0, value = 0;
  for (std::size_t c = 0; c < m_types.size(); ++c) {
    float number = unset;
    if (m_types[c] == ColumnType::Float64) {
      if (value < row.values.size()) number = static_cast<float>(row.values[value]);
      ++value;
    } else {
      if (word < row.words.size() && !isLost(c)) {
        number = m_types[c] == ColumnType::Int32
                     ? static_cast<float>(std::bit_cast<std::int32_t>(row.words[word]))
                     : std::bit_cast<float>(row.words[word]);
      }
      ++word;
    }
    Extremes& now = m_now[c];
    // Written so that NaN on either side gives way.
    if (!(now.min <= number)) now.min = number == number ? number : now.min;
    if (!(now.max >= number)) now.max = number == number ? number : now.max;
    now.last = number;
  }
  if (++m_rows < SummaryPart::usualRows) return std::nullopt;
  closeBucket();
  if (m_part.buckets() < SummaryPart::mostBuckets) return std::nullopt;
  return take();
}

std::optional<SummaryPart> SummaryBuilder::finish() {
  if (m_rows > 0) closeBucket();
  if (m_part.buckets() == 0) return std::nullopt;
  return take();
}

void SummaryBuilder::closeBucket() {
  m_part.begin.push_back(m_begin);
  m_part.end.push_back(m_end);
  m_part.rows.push_back(m_rows);
  for (std::size_t c = 0; c < m_now.size(); ++c) {
    m_part.columns[c].min.push_back(m_now[c].min);
    m_part.columns[c].max.push_back(m_now[c].max);
    m_part.columns[c].last.push_back(m_now[c].last);
  }
  m_now.assign(m_types.size(), {unset, unset, unset});
  m_rows = 0;
}

SummaryPart SummaryBuilder::take() {
  for (SummaryPart::Column& column : m_part.columns) {
    shorten(column.min);
    shorten(column.max);
    shorten(column.last);
  }
  SummaryPart done = std::exchange(m_part, {});
  m_part.columns.resize(m_types.size());
  return done;
}

}  // namespace pitchboard::telemetry
