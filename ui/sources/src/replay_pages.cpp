// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_pages.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include <robotlink/blackboard/variable_meanings.h>

namespace pitchboard::ui {

using telemetry::GroupId;
using telemetry::TimeRange;

namespace {

// Room for two long stretches (what plots show, and a range that is measured) and two short ones
// (moments elsewhere): plots and marks never push out each other's rows.
constexpr double longStretch = 7.0 / 16, shortStretch = 1.0 / 16;
constexpr double nearby = 5.0;  // s; around a moment, because the next one is mostly near
constexpr std::size_t maxWanted = 8;

bool contains(TimeRange outer, TimeRange inner) {
  return outer.begin <= inner.begin && inner.end <= outer.end;
}

}  // namespace

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

telemetry::GroupInfo shownGroup(const telemetry::SessionGroup& group) {
  telemetry::GroupInfo info = group.info;
  link::VariableMeanings::published().describeLost(info);
  return info;
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

/// Three quarters of the room are for rows, one for the coarse pictures. Needs the lock.
double ReplayPages::secondsThatFit() const {
  return 0.75 * static_cast<double>(m_room) / m_bytesPerSecond;
}

void ReplayPages::setBytes(std::size_t bytes) {
  const std::lock_guard lock(m_mutex);
  m_room = bytes;
  keepFreeSpace();
  forgetSummaries();
}

/// Of the stretches those that were used last stay. Needs the lock.
void ReplayPages::keepFreeSpace() {
  double rest = secondsThatFit();
  std::erase_if(m_held, [&rest](const Held& held) {
    rest -= held.range.end - held.range.begin;
    return rest < 0.0;
  });
}

std::size_t ReplayPages::bytes() {
  const std::lock_guard lock(m_mutex);
  std::size_t sum = 0;
  for (const Held& held : m_held) sum += held.rows->memoryBytes();
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

std::optional<telemetry::SeriesPages::Stretch> ReplayPages::held(GroupId group,
                                                                 std::optional<TimeRange> range) {
  const std::lock_guard lock(m_mutex);
  const auto found = std::ranges::find_if(
      m_held, [&range](const Held& one) { return !range || contains(one.range, *range); });
  if (found == m_held.end()) return std::nullopt;
  m_held.splice(m_held.begin(), m_held, found);
  auto view = found->rows->view(group);
  if (!view) return std::nullopt;
  return Stretch{found->range, std::move(view)};
}

void ReplayPages::want(TimeRange range) {
  range = {std::max(range.begin, m_range.begin), std::min(range.end, m_range.end)};
  const double length = range.end - range.begin;
  const std::lock_guard lock(m_mutex);
  const double fits = secondsThatFit();
  const bool isShort = length <= fits * shortStretch / 2;
  const double room = fits * (isShort ? shortStretch : longStretch) - length;
  if (length < 0.0 || room < 0.0) return;
  const auto has = [&range](const auto& one) { return contains(one, range); };
  if (std::ranges::any_of(m_held, has, &Held::range) || std::ranges::any_of(m_wanted, has)) return;
  // Reads what is beside it as well: the next range is mostly near.
  const double more = std::min(std::max(length, nearby), room / 2);
  m_wanted.push_back(
      {std::max(range.begin - more, m_range.begin), std::min(range.end + more, m_range.end)});
  // A long stretch that is looked at comes at once, what is beside it afterwards.
  if (length > nearby) m_wanted.push_back(range);
  while (m_wanted.size() > maxWanted) m_wanted.pop_front();
  work();
}

bool ReplayPages::isReading(TimeRange range) {
  const std::lock_guard lock(m_mutex);
  return std::ranges::any_of(m_wanted, [&range](TimeRange one) { return contains(one, range); });
}

void ReplayPages::setListener(std::function<void()> listener) {
  const std::lock_guard lock(m_listening);
  m_listener = std::move(listener);
}

void ReplayPages::notify() {
  const std::lock_guard lock(m_listening);
  if (m_listener) m_listener();
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
        // What is looked at closely first; the coarse pictures of a long session take a while.
        if (!m_wanted.empty()) {
          range = m_wanted.back();
        } else if (!m_askedFor.empty()) {
          group = *m_askedFor.begin();
        }
        if (m_ends || (!group && !range && !isMeasuring())) {
          m_working = false;
          return;
        }
      }
      if (range) {
        readRows(*range);
      } else if (group) {
        readSummary(*group);
      } else {
        measure();
      }
      notify();
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
  ++m_revision;
}

/// Of those that nobody has drawn for the longest time the first and the last part are left; one is
/// always kept whole. Needs the lock.
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
  for (std::size_t i = 0; i + 1 < whole.size() && sum > m_room / 4; ++i) {
    Summary& summary = m_summaries[whole[i]];
    auto ends = std::make_shared<telemetry::GroupSummary>();
    const auto& parts = summary.parts->parts;
    if (!parts.empty()) ends->parts.push_back(parts.front());
    if (parts.size() > 1) ends->parts.push_back(parts.back());
    sum = sum - summary.parts->bytes() + ends->bytes();
    summary = {std::move(ends), false};
  }
}

std::shared_ptr<telemetry::SeriesStore> ReplayPages::rowsOf(TimeRange range,
                                                            const std::function<bool()>& goOn) {
  // Its length is limited, so that the store has no limit of its own.
  auto rows = std::make_shared<telemetry::SeriesStore>(
      telemetry::SeriesOptions{std::numeric_limits<std::size_t>::max()});
  std::vector<GroupId> ids;
  for (const telemetry::SessionGroup& group : m_reader.groups()) {
    ids.push_back(rows->addGroup(shownGroup(group)));
  }
  // A value holds until the next row: the stretch begins with the row before it.
  std::vector<telemetry::SessionRow> before;
  m_reader.rowsAt(range.begin, before);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].present && before[i].time < range.begin) rows->append(ids[i], before[i].view());
  }
  bool wanted = true;
  std::uint64_t count = 0;
  constexpr std::uint64_t rowsBetweenLooks = 4096;
  m_reader.rows(range, {}, [&](GroupId group, const telemetry::RowView& row) {
    rows->append(ids[group], row);
    if (++count % rowsBetweenLooks == 0) wanted = goOn();
    return wanted;
  });
  return wanted ? rows : nullptr;
}

void ReplayPages::readRows(TimeRange range) {
  auto rows = rowsOf(range, [this, range] {
    const std::lock_guard lock(m_mutex);
    return !m_ends && std::ranges::find(m_wanted, range) != m_wanted.end();
  });
  const std::lock_guard lock(m_mutex);
  std::erase(m_wanted, range);
  if (!rows) return;  // other stretches are looked at by now
  // The part of it that was read first.
  m_held.remove_if([&range](const Held& held) { return contains(range, held.range); });
  m_held.push_front({range, std::move(rows)});
  keepFreeSpace();
  ++m_revision;
}

std::optional<telemetry::SeriesStatistics> ReplayPages::statistics(GroupId group,
                                                                   std::uint32_t column,
                                                                   TimeRange range) {
  const std::lock_guard lock(m_mutex);
  const auto known = std::ranges::find_if(m_measures, [&](const Measure& one) {
    return one.group == group && one.column == column && one.range == range;
  });
  if (known != m_measures.end()) {
    return known->isDone() ? std::optional(known->sum.result()) : std::nullopt;
  }
  // While a mark is dragged nobody waits for where it was.
  m_measures.remove_if([&](const Measure& one) {
    return one.group == group && one.column == column && !one.isDone();
  });
  m_measures.push_front({group, column, range, {}, range.begin});
  constexpr std::size_t maxMeasures = 100;
  if (m_measures.size() > maxMeasures) m_measures.pop_back();
  work();
  return std::nullopt;
}

/// Needs the lock.
bool ReplayPages::isMeasuring() const {
  return !std::ranges::all_of(m_measures, &Measure::isDone);
}

/// One stretch further, so that rows that are looked at need not wait for a whole session.
void ReplayPages::measure() {
  TimeRange part{};
  std::vector<std::pair<GroupId, std::uint32_t>> columns;
  {
    const std::lock_guard lock(m_mutex);
    const auto first = std::ranges::find_if_not(m_measures, &Measure::isDone);
    if (first == m_measures.end()) return;
    const double length = std::max(nearby, secondsThatFit() * shortStretch);
    part = {first->next, std::min(first->next + length, first->range.end)};
    // Measures of one range are computed together.
    for (const Measure& one : m_measures) {
      if (one.next == part.begin && one.range == first->range) {
        columns.emplace_back(one.group, one.column);
      }
    }
  }
  const auto rows = rowsOf(part, [this] {
    const std::lock_guard lock(m_mutex);
    return !m_ends && m_wanted.empty();
  });
  if (!rows) return;
  std::vector<telemetry::Sample> samples;
  std::vector<double> values;
  for (const auto& [group, column] : columns) {
    rows->view(group)->samples(column, part, samples);
    values.clear();
    for (const telemetry::Sample& sample : samples) values.push_back(sample.value);
    const std::lock_guard lock(m_mutex);
    for (Measure& one : m_measures) {
      if (one.group != group || one.column != column || one.next != part.begin) continue;
      one.sum.add(values.data(), values.size());
      one.next = std::nextafter(part.end, std::numeric_limits<double>::infinity());
      if (one.isDone()) ++m_revision;
    }
  }
}

}  // namespace pitchboard::ui
