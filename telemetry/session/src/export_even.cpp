// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_even.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pitchboard::telemetry {
namespace {

double numberOf(const SelectedColumn& column, const RowView& row) {
  if (column.type == ColumnType::Float64) return row.values[column.index];
  const std::uint32_t word = row.words[column.index];
  return column.type == ColumnType::Int32 ? std::bit_cast<std::int32_t>(word)
                                          : static_cast<double>(std::bit_cast<float>(word));
}

}  // namespace

EvenRows::EvenRows(const SessionReader& session, const std::vector<SelectedGroup>& selected,
                   const Resampling& resampling, TimeRange range)
    : m_selected(selected), m_resampling(resampling), m_range(range), m_groups(selected.size()) {
  std::vector<GroupId> groups;
  for (std::size_t g = 0; g < selected.size(); ++g) {
    m_groups[g].selected = selected[g].selected;
    if (selected[g].selected) groups.push_back(static_cast<GroupId>(g));
    for (const SelectedColumn& column : selected[g].columns) {
      const ColumnInfo& info = session.groups()[g].info.columns[column.column];
      m_groups[g].held.push_back(!resampling.interpolate || info.kind != ColumnKind::Number);
    }
  }
  if (groups.empty()) return;
  session.rows({-1e18, 1e18}, groups, [this](GroupId, const RowView& row) {
    m_begin = row.time;
    return false;
  });
  const auto all = session.range();
  if (!all || m_range.begin > all->end) m_range.end = -1e300;  // no line lies behind the last row
  if (!(m_range.begin > m_begin) || m_range.end < m_range.begin) return;
  m_lines = static_cast<std::uint64_t>((m_range.begin - m_begin) * resampling.rate);
  while (next() < m_range.begin) ++m_lines;
}

bool EvenRows::add(const SessionItem& item, const Write& write) {
  take(item);
  // A group without new rows is not waited for.
  return writeUntil(readyUntil(item.time), write) && !isDone();
}

bool EvenRows::writeUntil(double time, const Write& write) {
  while (m_any && next() <= std::min(time, m_range.end)) {
    fill(next());
    if (!write(next(), m_line)) return false;
    ++m_lines;
  }
  return true;
}

void EvenRows::take(const SessionItem& item) {
  Group& group = m_groups[item.group];
  Row row{item.time, {}};
  row.values.reserve(group.held.size());
  for (const SelectedColumn& column : m_selected[item.group].columns) {
    row.values.push_back(numberOf(column, item.row));
  }
  group.rows.push_back(std::move(row));
  m_any = true;
  while (group.rows.size() > 1 && group.rows[1].time <= next()) group.rows.pop_front();
  m_last = std::max(m_last, item.time);
}

// Up to here no row can come any more that a line needs.
double EvenRows::readyUntil(double now) const {
  double ready = now;
  for (const Group& group : m_groups) {
    if (!group.selected || group.rows.empty()) continue;
    // The next row may stand at the very time of the last one.
    ready = std::min(ready, std::nextafter(group.rows.back().time, -1e300));
  }
  return std::max(ready, now - Resampling::maxHold);
}

void EvenRows::fill(double time) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  m_line.clear();
  for (Group& group : m_groups) {
    if (!group.selected) continue;
    auto& rows = group.rows;
    while (rows.size() > 1 && rows[1].time <= time) rows.pop_front();
    const bool holds =
        !rows.empty() && rows[0].time <= time && time - rows[0].time <= Resampling::maxHold;
    const bool between =
        holds && rows.size() > 1 && rows[1].time - rows[0].time <= Resampling::maxHold;
    for (std::size_t i = 0; i < group.held.size(); ++i) {
      const bool asItIs = holds && (group.held[i] || rows[0].time == time);
      if (asItIs) {
        m_line.push_back(rows[0].values[i]);
      } else if (!between) {
        m_line.push_back(nothing);
      } else {
        const double share = (time - rows[0].time) / (rows[1].time - rows[0].time);
        m_line.push_back(rows[0].values[i] + share * (rows[1].values[i] - rows[0].values[i]));
      }
    }
  }
}

}  // namespace pitchboard::telemetry
