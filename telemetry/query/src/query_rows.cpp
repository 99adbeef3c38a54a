// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/query_rows.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <telemetry/series/losable.h>
#include <telemetry/series/robot_names.h>

namespace pitchboard::telemetry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t samplesAtOnce = 4096;

/// Takes the wanted values out of the rows of a group.
struct RowValues {
  struct Column {
    Slot slot;
    std::optional<Losable> losable;
  };
  std::vector<Column> columns{};
  std::vector<double> values{};

  RowValues(const GroupInfo& group, const std::vector<std::uint32_t>& wanted)
      : values(wanted.size()) {
    const std::vector<Slot> slots = slotsOf(group.columns);
    const std::vector<Losable> losable = losableColumns(group);
    for (const std::uint32_t column : wanted) {
      const auto found = std::ranges::find(losable, column, &Losable::column);
      columns.push_back(
          {slots[column], found == losable.end() ? std::nullopt : std::optional(*found)});
    }
  }
  std::span<const double> of(const RowView& row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Column& column = columns[i];
      if (column.losable && column.losable->isLost(row)) {
        values[i] = std::nan("");
      } else if (column.slot.type == ColumnType::Float64) {
        values[i] = row.values[column.slot.index];
      } else {
        const std::uint32_t word = row.words[column.slot.index];
        values[i] = column.slot.type == ColumnType::Int32
                        ? static_cast<double>(std::bit_cast<std::int32_t>(word))
                        : static_cast<double>(std::bit_cast<float>(word));
      }
    }
    return values;
  }
};

void visitFile(const SessionReader& session, TimeRange range, std::span<const WantedColumns> wanted,
               const QueryRows::Visit& visit) {
  std::vector<GroupId> groups;
  std::vector<RowValues> values;
  std::vector<std::size_t> indices(session.groups().size(), 0);
  for (const WantedColumns& one : wanted) {
    indices[one.group] = groups.size();
    groups.push_back(one.group);
    values.emplace_back(session.groups()[one.group].info, one.columns);
  }
  if (groups.empty()) return;
  session.rows(range, groups, [&](GroupId group, const RowView& row) {
    const std::size_t index = indices[group];
    return visit(index, row.time, values[index].of(row));
  });
}

/// Reads the samples of a group piece by piece.
class GroupSamples {
 public:
  GroupSamples(std::shared_ptr<const GroupView> view, std::vector<std::uint32_t> columns,
               TimeRange range)
      : m_view(std::move(view)),
        m_columns(std::move(columns)),
        m_rest(range),
        m_samples(m_columns.size()),
        m_values(m_columns.size()) {
    fill();
  }
  /// Infinity if there is no other row.
  double time() const { return m_next < m_size ? m_samples.front()[m_next].time : infinity; }
  std::span<const double> take() {
    for (std::size_t i = 0; i < m_columns.size(); ++i) m_values[i] = m_samples[i][m_next].value;
    if (++m_next == m_size) fill();
    return m_values;
  }

 private:
  void fill() {
    m_next = m_size = 0;
    if (m_isAll || m_columns.empty()) return;
    // Every column has a sample for each row.
    m_isAll = m_view->samples(m_columns[0], m_rest, m_samples[0], samplesAtOnce);
    m_size = m_samples[0].size();
    if (m_size == 0) return;
    if (!m_isAll) {
      // Rows of one time stay together, so that the next piece can begin after it.
      const double last = m_samples[0].back().time;
      while (m_size > 1 && m_samples[0][m_size - 1].time == last) --m_size;
      m_samples[0].resize(m_size);
    }
    const TimeRange piece{m_rest.begin, m_samples[0].back().time};
    for (std::size_t i = 1; i < m_columns.size(); ++i) {
      m_view->samples(m_columns[i], piece, m_samples[i], m_size);
    }
    m_rest.begin = std::nextafter(piece.end, infinity);
  }

  std::shared_ptr<const GroupView> m_view;
  std::vector<std::uint32_t> m_columns;
  TimeRange m_rest;
  std::vector<std::vector<Sample>> m_samples;  // of each column
  std::vector<double> m_values;
  std::size_t m_next = 0, m_size = 0;
  bool m_isAll = false;
};

void visitMemory(const std::vector<std::shared_ptr<const GroupView>>& views, TimeRange range,
                 std::span<const WantedColumns> wanted, const QueryRows::Visit& visit) {
  std::vector<GroupSamples> groups;
  for (const WantedColumns& one : wanted) groups.emplace_back(views[one.group], one.columns, range);
  while (true) {
    std::size_t first = 0;
    for (std::size_t i = 1; i < groups.size(); ++i) {
      if (groups[i].time() < groups[first].time()) first = i;
    }
    if (groups.empty() || groups[first].time() == infinity) return;
    const double time = groups[first].time();
    if (!visit(first, time, groups[first].take())) return;
  }
}

}  // namespace

QueryRows::QueryRows(const SessionReader& session) : m_range(session.range()) {
  for (const SessionGroup& group : session.groups()) m_groups.push_back(&group.info);
  m_visit = [&session](TimeRange range, std::span<const WantedColumns> wanted, const Visit& visit) {
    visitFile(session, range, wanted, visit);
  };
}

QueryRows::QueryRows(const SeriesStore& store) {
  std::vector<std::shared_ptr<const GroupView>> views;
  for (GroupId group = 0; group < store.groups(); ++group) {
    views.push_back(store.view(group));
    m_groups.push_back(&views.back()->info());
    const auto range = views.back()->range();
    if (!range) continue;
    if (!m_range) m_range = range;
    m_range = TimeRange{std::min(m_range->begin, range->begin), std::max(m_range->end, range->end)};
  }
  m_visit = [views = std::move(views)](TimeRange range, std::span<const WantedColumns> wanted,
                                       const Visit& visit) {
    visitMemory(views, range, wanted, visit);
  };
}

Result<std::vector<GroupId>> QueryRows::groupsNamed(std::string_view name) const {
  return telemetry::groupsNamed(name, m_groups);
}

}  // namespace pitchboard::telemetry
