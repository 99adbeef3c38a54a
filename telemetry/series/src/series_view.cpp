// SPDX-License-Identifier: GPL-3.0-or-later
#include "series_view.h"

#include "series_view_search.h"

namespace pitchboard::telemetry::series {

View::View(std::shared_ptr<const State> state)
    : m_state(std::move(state)), m_fullUnits(m_state->full->size()) {
  m_tail.rows = m_state->staging->rows.load(std::memory_order_acquire);
  m_tail.times = m_state->staging->times.get();
  m_tail.blocks = 1;
  if (m_tail.rows > 0) {
    m_tail.first = m_tail.times[0];
    m_tail.last = m_tail.times[m_tail.rows - 1];
  }
  m_rows = m_fullUnits * chunkRows + m_state->blocks.size() * blockRows + m_tail.rows;
}

const ChunkView& View::unit(std::size_t number) const {
  if (number < m_fullUnits) return (*m_state->full)[number];
  number -= m_fullUnits;
  return number < m_state->blocks.size() ? m_state->blocks[number] : m_tail;
}

std::size_t View::firstRow(std::size_t unit) const {
  return unit < m_fullUnits ? unit * chunkRows
                            : m_fullUnits * chunkRows + (unit - m_fullUnits) * blockRows;
}

View::Place View::place(std::size_t row) const {
  if (row < m_fullUnits * chunkRows) {
    return {&(*m_state->full)[row / chunkRows], static_cast<std::uint32_t>(row % chunkRows)};
  }
  row -= m_fullUnits * chunkRows;
  return {&unit(m_fullUnits + row / blockRows), static_cast<std::uint32_t>(row % blockRows)};
}

double View::timeOf(std::size_t row) const {
  const Place at = place(row);
  return at.unit->times[at.row];
}

std::optional<TimeRange> View::range() const {
  if (m_rows == 0) return std::nullopt;
  return TimeRange{timeOf(0), timeOf(m_rows - 1)};
}

double View::rate() const {
  if (m_rows < 2) return 0.0;
  const double last = timeOf(m_rows - 1);
  const std::size_t first = rowsBefore(last - 1.0);
  const double span = last - timeOf(first);
  // Rows of one time count once: edits of a match that is paused are no rate.
  std::size_t steps = 0;
  for (std::size_t row = first + 1; row < m_rows; ++row) {
    if (timeOf(row) > timeOf(row - 1)) ++steps;
  }
  return span > 0.0 ? static_cast<double>(steps) / span : 0.0;
}

std::size_t View::rowsBefore(double time) const {
  return Search<false>(*this, time)(time);
}

double View::number(std::uint32_t column, std::size_t row) const {
  return withType(m_state->layout->slots[column].type, [&](auto zero) {
    return static_cast<double>(value<decltype(zero)>(column, row));
  });
}

std::optional<Sample> View::latest(std::uint32_t column) const {
  const auto slot = slotOf(column);
  if (m_rows == 0 || !slot) return std::nullopt;
  return Sample{timeOf(m_rows - 1), number(*slot, m_rows - 1)};
}

std::optional<Sample> View::at(std::uint32_t column, double time) const {
  const auto slot = slotOf(column);
  if (!slot) return std::nullopt;
  const std::size_t rows = Search<true>(*this, time)(time);
  if (rows == 0) return std::nullopt;
  return Sample{timeOf(rows - 1), number(*slot, rows - 1)};
}

bool View::rowAt(double time, double& rowTime, std::vector<std::uint32_t>& words,
                 std::vector<double>& values) const {
  const std::size_t rows = Search<true>(*this, time)(time);
  if (rows == 0) return false;
  rowTime = row(rows - 1, words, values);
  return true;
}

double View::row(std::size_t number, std::vector<std::uint32_t>& words,
                 std::vector<double>& values) const {
  const Layout& layout = *m_state->layout;
  const Place at = place(number);
  words.resize(layout.words);
  values.resize(layout.values);
  if (!at.unit->columns) {
    const Staging& staging = *m_state->staging;
    std::copy_n(staging.words.get() + std::size_t{at.row} * layout.keptWords, layout.words,
                words.begin());
    std::copy_n(staging.values.get() + std::size_t{at.row} * layout.keptValues, layout.values,
                values.begin());
    return staging.times[at.row];
  }
  for (std::uint32_t c = 0; c < layout.info.columns.size(); ++c) {
    const Column& column = at.unit->columns[c];
    const Slot slot = layout.slots[c];
    if (slot.type == ColumnType::Float64) {
      values[slot.index] = column.at<double>(at.row, at.unit->blocks);
    } else {  // bit patterns: the type of the words does not matter
      words[slot.index] = column.at<std::uint32_t>(at.row, at.unit->blocks);
    }
  }
  return at.unit->times[at.row];
}

std::optional<double> View::lastChange(std::uint32_t column) const {
  const auto slot = slotOf(column);
  if (m_rows == 0 || !slot) return std::nullopt;
  return timeOf(withType(m_state->layout->slots[*slot].type,
                         [&](auto zero) { return lastChangedRow<decltype(zero)>(*slot); }));
}

}  // namespace pitchboard::telemetry::series
