// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_pages.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <vector>

namespace pitchboard::ui {

using telemetry::GroupId;
using telemetry::TimeRange;

double bytesOfRows(const telemetry::SessionReader& session) {
  double sum = 0.0;
  for (const telemetry::SessionGroup& group : session.groups()) {
    double row = sizeof(double);
    for (const telemetry::ColumnInfo& column : group.info.columns) {
      row += column.type == telemetry::ColumnType::Float64 ? 8.0 : 4.0;
    }
    sum += row * static_cast<double>(group.rows);
  }
  return sum;
}

ReplayPages::ReplayPages(telemetry::SessionReader reader, std::size_t bytes)
    : m_reader(std::move(reader)), m_room(bytes) {
  if (const auto range = m_reader.range()) m_range = {range->begin, range->end};
  m_bytesPerSecond =
      std::max(1.0, bytesOfRows(m_reader) / std::max(m_range.end - m_range.begin, 1e-3));
}

ReplayPages::~ReplayPages() {
  m_ends = true;
  m_worker.waitForDone();
}

// A half for rows, a half for the coarse pictures.
double ReplayPages::longest() const {
  const std::lock_guard lock(m_mutex);
  return static_cast<double>(m_room / 2) / m_bytesPerSecond;
}

void ReplayPages::setBytes(std::size_t bytes) {
  const std::lock_guard lock(m_mutex);
  m_room = bytes;
}

std::size_t ReplayPages::bytes() {
  const std::lock_guard lock(m_mutex);
  std::size_t sum = m_rows ? m_rows->memoryBytes() : 0;
  for (const auto& [group, summary] : m_summaries) sum += summary.parts->bytes();
  return sum;
}

std::shared_ptr<const telemetry::GroupSummary> ReplayPages::summary(GroupId group, bool whole) {
  const std::lock_guard lock(m_mutex);
  if (whole) {
    m_recent.remove(group);
    m_recent.push_front(group);
  }
  const auto known = m_summaries.find(group);
  if (known != m_summaries.end() && (known->second.whole || !whole)) return known->second.parts;
  if (group < m_reader.groups().size() && m_askedFor.insert(group).second) work();
  return known != m_summaries.end() ? known->second.parts : nullptr;
}

std::optional<telemetry::SeriesPages::Stretch> ReplayPages::held(GroupId group) {
  const std::lock_guard lock(m_mutex);
  auto view = m_rows ? m_rows->view(group) : nullptr;
  if (!view) return std::nullopt;
  return Stretch{*m_held, std::move(view)};
}

void ReplayPages::want(TimeRange range) {
  range = {std::max(range.begin, m_range.begin), std::min(range.end, m_range.end)};
  const double longestNow = longest();
  const double length = range.end - range.begin;
  if (length < 0.0 || length > longestNow) return;
  // What is beside it as well: whoever looks moves on.
  const double more = std::min(length, (longestNow - length) / 2.0);
  const TimeRange wide{std::max(range.begin - more, m_range.begin),
                       std::min(range.end + more, m_range.end)};
  const std::lock_guard lock(m_mutex);
  if (m_held && m_held->begin <= range.begin && range.end <= m_held->end) return;
  if (m_wanted && m_wanted->begin <= range.begin && range.end <= m_wanted->end) return;
  m_wanted = wide;
  work();
}

/// Needs the lock.
void ReplayPages::work() {
  if (m_working || m_ends) return;
  m_working = true;
  m_worker.start([this] {
    for (;;) {
      std::optional<GroupId> group;
      std::optional<TimeRange> range;
      {
        const std::lock_guard lock(m_mutex);
        if (!m_askedFor.empty()) {
          group = *m_askedFor.begin();
        } else if (m_wanted) {
          range = m_wanted;
        }
        if (m_ends || (!group && !range)) {
          m_working = false;
          return;
        }
      }
      if (group) {
        readSummary(*group);
      } else {
        readRows(*range);
      }
    }
  });
}

void ReplayPages::readSummary(GroupId group) {
  auto read = std::make_shared<const telemetry::GroupSummary>(
      m_reader.summary(group, [this] { return !m_ends; }));
  const std::lock_guard lock(m_mutex);
  m_askedFor.erase(group);
  m_summaries[group] = {std::move(read), true};
  forgetSummaries();
}

/// Of those that nobody has drawn for the longest time the first and the last part are left; one is
/// always kept whole.
void ReplayPages::forgetSummaries() {
  std::size_t sum = 0;
  std::vector<GroupId> whole;  // what was drawn last stands last
  for (const auto& [group, summary] : m_summaries) {
    sum += summary.parts->bytes();
    if (summary.whole) whole.push_back(group);
  }
  const auto age = [this](GroupId group) {
    return std::distance(m_recent.begin(), std::find(m_recent.begin(), m_recent.end(), group));
  };
  std::ranges::stable_sort(whole, std::greater(), age);
  for (std::size_t i = 0; i + 1 < whole.size() && sum > m_room / 2; ++i) {
    Summary& summary = m_summaries[whole[i]];
    auto ends = std::make_shared<telemetry::GroupSummary>();
    const auto& parts = summary.parts->parts;
    if (!parts.empty()) ends->parts.push_back(parts.front());
    if (parts.size() > 1) ends->parts.push_back(parts.back());
    sum = sum - summary.parts->bytes() + ends->bytes();
    summary = {std::move(ends), false};
  }
}

void ReplayPages::readRows(TimeRange range) {
  std::size_t room = 0;
  {
    const std::lock_guard lock(m_mutex);
    room = m_room;
  }
  auto rows = std::make_shared<telemetry::SeriesStore>(telemetry::SeriesOptions{room});
  std::vector<GroupId> ids;
  for (const telemetry::SessionGroup& group : m_reader.groups()) {
    ids.push_back(rows->addGroup(group.info));
  }
  bool wanted = true;
  std::uint64_t count = 0;
  constexpr std::uint64_t rowsBetweenLooks = 4096;
  m_reader.rows(range, {}, [&](GroupId group, const telemetry::RowView& row) {
    rows->append(ids[group], row);
    if (++count % rowsBetweenLooks == 0) {
      const std::lock_guard lock(m_mutex);
      wanted = !m_ends && m_wanted == range;
    }
    return wanted;
  });
  const std::lock_guard lock(m_mutex);
  if (!wanted) return;  // another stretch is looked at by now
  m_rows = std::move(rows);
  m_held = range;
  m_wanted.reset();
}

}  // namespace pitchboard::ui
