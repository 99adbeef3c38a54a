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

// Loops without branches, which compilers turn into operations on several columns at once.

void copyWords(const std::uint32_t* words, const std::uint32_t* intMask, std::size_t count,
               float* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto whole = static_cast<float>(std::bit_cast<std::int32_t>(words[i]));
    to[i] = std::bit_cast<float>((std::bit_cast<std::uint32_t>(whole) & intMask[i]) |
                                 (words[i] & ~intMask[i]));
  }
}

void copyValues(const double* values, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(values[i]);
}

/// NaN changes nothing.
void extend(const float* numbers, std::size_t count, float* min, float* max) {
  for (std::size_t i = 0; i < count; ++i) {
    min[i] = numbers[i] < min[i] ? numbers[i] : min[i];
    max[i] = numbers[i] > max[i] ? numbers[i] : max[i];
  }
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
  for (const Losable& column : losableColumns(group)) {
    for (const Losable::Flag& flag : column.flags) {
      if (flag.slot.type == ColumnType::Float64)
        m_valueHoles.push_back({flag.slot.index, column.column, flag.value});
      else
        m_wordHoles.push_back({flag.slot.index, column.column, flag.word});
    }
  }
  const std::vector<Slot> places = slotsOf(group.columns);
  for (std::size_t c = 0; c < places.size(); ++c) {
    const bool isWord = places[c].type != ColumnType::Float64;
    if (m_runs.empty() || m_runs.back().isWord != isWord) {
      m_runs.push_back({isWord, c, places[c].index, 0});
    }
    ++m_runs.back().count;
    m_intMask.push_back(places[c].type == ColumnType::Int32 ? ~0U : 0U);
  }
  m_part.columns.resize(places.size());
  beginBucket();
}

void SummaryBuilder::beginBucket() {
  const std::size_t columns = m_intMask.size();
  m_min.assign(columns, std::numeric_limits<float>::infinity());
  m_max.assign(columns, -std::numeric_limits<float>::infinity());
  m_last.assign(columns, unset);
  m_rows = 0;
}

/// Makes `m_last` the numbers of this row.
void SummaryBuilder::read(const RowView& row) {
  for (const Run& run : m_runs) {
    const std::size_t size = run.isWord ? row.words.size() : row.values.size();
    const std::size_t index = std::min(run.index, size);
    const std::size_t count = std::min(run.count, size - index);
    float* const to = m_last.data() + run.column;
    if (run.isWord)
      copyWords(row.words.data() + index, m_intMask.data() + run.column, count, to);
    else
      copyValues(row.values.data() + index, count, to);
    std::fill(to + count, to + run.count, unset);
  }
  for (const auto& hole : m_wordHoles) {
    if (hole.index < row.words.size() && row.words[hole.index] == hole.when)
      m_last[hole.column] = unset;
  }
  for (const auto& hole : m_valueHoles) {
    if (hole.index < row.values.size() && row.values[hole.index] == hole.when)
      m_last[hole.column] = unset;
  }
}

std::optional<SummaryPart> SummaryBuilder::add(double time, const RowView& row) {
  std::optional<SummaryPart> full;
  if (m_rows > 0 && time - m_end > SummaryPart::maxSilence) full = closeBucket();
  if (m_rows == 0) m_begin = time;
  m_end = time;
  read(row);
  extend(m_last.data(), m_last.size(), m_min.data(), m_max.data());
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
  for (std::size_t c = 0; c < m_last.size(); ++c) {
    const bool hasNumber = m_min[c] <= m_max[c];
    m_part.columns[c].min.push_back(hasNumber ? m_min[c] : unset);
    m_part.columns[c].max.push_back(hasNumber ? m_max[c] : unset);
    m_part.columns[c].last.push_back(m_last[c]);
  }
  beginBucket();
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
  m_part.columns.resize(m_last.size());
  return done;
}

}  // namespace pitchboard::telemetry
