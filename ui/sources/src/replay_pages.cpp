// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_pages.h"

#include <algorithm>

namespace pitchboard::ui {

using telemetry::GroupId;
using telemetry::TimeRange;

ReplayPages::ReplayPages(telemetry::SessionReader reader, std::size_t bytes)
    : m_reader(std::move(reader)), m_room(bytes) {
  if (const auto range = m_reader.range()) m_range = {range->begin, range->end};
  double sum = 0.0;
  for (const telemetry::SessionGroup& group : m_reader.groups()) {
    double row = sizeof(double);
    for (const telemetry::ColumnInfo& column : group.info.columns) {
      row += column.type == telemetry::ColumnType::Float64 ? 8.0 : 4.0;
    }
    sum += row * static_cast<double>(group.rows);
  }
  m_bytesPerSecond = std::max(1.0, sum / std::max(m_range.end - m_range.begin, 1e-3));
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
  for (const auto& [group, summary] : m_summaries) sum += summary->bytes();
  return sum;
}

std::shared_ptr<const telemetry::GroupSummary> ReplayPages::summary(GroupId group) {
  const std::lock_guard lock(m_mutex);
  m_recent.remove(group);
  m_recent.push_front(group);
  if (const auto known = m_summaries.find(group); known != m_summaries.end()) return known->second;
  if (group < m_reader.groups().size() && m_askedFor.insert(group).second) work();
  return nullptr;
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
  m_summaries[group] = std::move(read);
  forgetSummaries();
}

/// Those that nobody has looked at for the longest time; one is always kept.
void ReplayPages::forgetSummaries() {
  std::size_t sum = 0;
  for (const auto& [group, summary] : m_summaries) sum += summary->bytes();
  while (sum > m_room / 2 && m_summaries.size() > 1) {
    const auto last = std::find_if(m_recent.rbegin(), m_recent.rend(),
                                   [this](GroupId group) { return m_summaries.contains(group); });
    if (last == m_recent.rend()) return;
    sum -= m_summaries[*last]->bytes();
    m_summaries.erase(*last);
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
