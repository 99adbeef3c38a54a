// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_summary.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

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

SummaryBuilder::SummaryBuilder(const GroupInfo& group)
    : m_slots(slotsOf(group.columns)), m_losable(losableColumns(group)) {
  m_now.assign(m_slots.size(), {unset, unset, unset});
  m_part.columns.resize(m_slots.size());
}

std::optional<SummaryPart> SummaryBuilder::add(double time, const RowView& row) {
  std::optional<SummaryPart> full;
  if (m_rows > 0 && time - m_end > SummaryPart::maxSilence) full = closeBucket();
  if (m_rows == 0) m_begin = time;
  m_end = time;
  auto losable = m_losable.begin();  // of the column, or of one behind it
  for (std::size_t c = 0; c < m_slots.size(); ++c) {
    const auto [type, index] = m_slots[c];
    const bool isLosable = losable != m_losable.end() && losable->column == c;
    const bool isLost = isLosable && losable->isLost(row);
    if (isLosable) ++losable;
    const bool isWord = type != ColumnType::Float64;
    float number = unset;
    if (!isLost && index < (isWord ? row.words.size() : row.values.size())) {
      number = type == ColumnType::Float64 ? static_cast<float>(row.values[index])
               : type == ColumnType::Int32
                   ? static_cast<float>(std::bit_cast<std::int32_t>(row.words[index]))
                   : std::bit_cast<float>(row.words[index]);
    }
    Extremes& now = m_now[c];
    // Written so that NaN on either side gives way.
    if (!(now.min <= number)) now.min = number == number ? number : now.min;
    if (!(now.max >= number)) now.max = number == number ? number : now.max;
    now.last = number;
  }
  return ++m_rows < SummaryPart::defaultRows ? full : closeBucket();
}

std::optional<SummaryPart> SummaryBuilder::finish() {
  if (auto full = closeBucket()) return full;
  if (m_part.buckets() == 0) return std::nullopt;
  return take();
}

std::optional<SummaryPart> SummaryBuilder::closeBucket() {
  if (m_rows == 0) return std::nullopt;
  m_part.begin.push_back(m_begin);
  m_part.end.push_back(m_end);
  m_part.rows.push_back(m_rows);
  for (std::size_t c = 0; c < m_now.size(); ++c) {
    m_part.columns[c].min.push_back(m_now[c].min);
    m_part.columns[c].max.push_back(m_now[c].max);
    m_part.columns[c].last.push_back(m_now[c].last);
  }
  m_now.assign(m_slots.size(), {unset, unset, unset});
  m_rows = 0;
  if (m_part.buckets() < SummaryPart::maxBuckets) return std::nullopt;
  return take();
}

SummaryPart SummaryBuilder::take() {
  for (SummaryPart::Column& column : m_part.columns) {
    shorten(column.min);
    shorten(column.max);
    shorten(column.last);
  }
  SummaryPart done = std::exchange(m_part, {});
  m_part.columns.resize(m_slots.size());
  return done;
}

}  // namespace pitchboard::telemetry
