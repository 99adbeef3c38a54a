// SPDX-License-Identifier: GPL-3.0-or-later
#include "latest_rows.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace pitchboard::link {

telemetry::GroupId LatestRows::addGroup(const telemetry::GroupInfo& info) {
  const auto found = std::ranges::find_if(
      m_groups, [&](const Group& group) { return group.info.name == info.name; });
  if (found != m_groups.end()) {
    *found = {info, telemetry::losableColumns(info), {}, {}};
    return static_cast<telemetry::GroupId>(found - m_groups.begin());
  }
  m_groups.push_back({info, telemetry::losableColumns(info), {}, {}});
  return static_cast<telemetry::GroupId>(m_groups.size() - 1);
}

void LatestRows::append(telemetry::GroupId group, const telemetry::RowView& row) {
  m_samples += group == 0;
  m_groups[group].words.assign(row.words.begin(), row.words.end());
  m_groups[group].values.assign(row.values.begin(), row.values.end());
}

std::optional<LatestRows::Place> LatestRows::find(std::string_view group,
                                                  std::string_view column) const {
  for (std::size_t g = 0; g < m_groups.size(); ++g) {
    if (m_groups[g].info.name != group) continue;
    const auto& columns = m_groups[g].info.columns;
    const auto found =
        std::ranges::find_if(columns, [&](const auto& one) { return one.name == column; });
    if (found == columns.end()) return {};
    return Place{g, static_cast<std::size_t>(found - columns.begin())};
  }
  return {};
}

std::vector<std::string> LatestRows::names() const {
  std::vector<std::string> all;
  for (const Group& group : m_groups) {
    for (const telemetry::ColumnInfo& column : group.info.columns)
      all.push_back(group.info.name + '/' + column.name);
  }
  return all;
}

double LatestRows::value(const Place& place) const {
  const Group& group = m_groups[place.group];
  if (place.column >= group.words.size() + group.values.size()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const bool isLost = std::ranges::any_of(group.losable, [&](const telemetry::Losable& one) {
    return one.column == place.column && one.isLost({0.0, group.words, group.values});
  });
  if (isLost) return std::numeric_limits<double>::quiet_NaN();
  if (place.column >= group.words.size()) return group.values[place.column - group.words.size()];
  const std::uint32_t word = group.words[place.column];
  if (group.info.columns[place.column].type == telemetry::ColumnType::Float32) {
    return static_cast<double>(std::bit_cast<float>(word));
  }
  return std::bit_cast<std::int32_t>(word);
}

}  // namespace pitchboard::link
