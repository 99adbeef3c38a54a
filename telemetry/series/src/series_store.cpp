// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_store.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <shared_mutex>

#include <telemetry/series/robot_names.h>
#include <telemetry/series/series_pages.h>

#include "series_group.h"

namespace pitchboard::telemetry {

struct SeriesStore::Impl {
  // Locked by writers every 64 rows, and while groups or the budget change: chunks come and go.
  std::mutex structure;
  // Of the list below, which only grows, and only under `structure`.
  mutable std::shared_mutex listMutex;
  std::vector<std::unique_ptr<series::Group>> groups;
  std::atomic<std::uint64_t> revision{0};
  std::atomic<std::size_t> bytes{0}, budget{0};
  std::function<void()> listener;
  std::atomic<bool> isTold{false};
  std::shared_ptr<SeriesPages> pages;  // of the list's mutex

  void account() {
    std::size_t sum = 0;
    for (const auto& group : groups) sum += group->bytes();
    bytes.store(sum, std::memory_order_relaxed);
  }

  /// Under `structure`.
  void keepBudget() {
    account();
    while (bytes.load(std::memory_order_relaxed) > budget.load(std::memory_order_relaxed)) {
      series::Group* oldest = nullptr;
      double time = 0.0;
      for (const auto& group : groups) {
        // By its end: a chunk of a slow group spans an hour, and leaves as a whole.
        const auto end = group->endOfOldest();
        if (end && (!oldest || *end < time)) {
          oldest = group.get();
          time = *end;
        }
      }
      if (!oldest) return;
      oldest->dropOldest();
      account();
    }
  }

  series::Group* writable(GroupId id) const {
    const std::shared_lock lock(listMutex);
    return id < groups.size() ? groups[id].get() : nullptr;
  }

  /// Under one of the locks.
  std::optional<GroupId> find(const GroupInfo& info) const {
    for (GroupId id = 0; id < groups.size(); ++id) {
      if (isSameGroup(groups[id]->view()->info(), info)) return id;
    }
    return std::nullopt;
  }
};

SeriesStore::SeriesStore(SeriesOptions options) : m_impl(std::make_unique<Impl>()) {
  m_impl->budget = options.memoryBudget;
}

SeriesStore::~SeriesStore() = default;

GroupId SeriesStore::addGroup(const GroupInfo& info) {
  Impl& d = *m_impl;
  const std::lock_guard structure(d.structure);
  const auto known = d.find(info);
  if (known) {
    series::Group& group = *d.groups[*known];
    if (!group.setInfo(info)) return *known;
    d.account();
    d.revision.fetch_add(1);
    return *known;
  }
  auto group = std::make_unique<series::Group>(std::make_shared<const series::Layout>(info));
  const std::lock_guard list(d.listMutex);
  d.groups.push_back(std::move(group));
  d.account();
  d.revision.fetch_add(1);
  return static_cast<GroupId>(d.groups.size() - 1);
}

void SeriesStore::describeGroups(std::span<const GroupInfo> groups) {
  Impl& d = *m_impl;
  const std::lock_guard structure(d.structure);
  // Readers of names wait, so that two groups that exchange names never have the same one.
  const std::lock_guard list(d.listMutex);
  for (const GroupInfo& info : groups) {
    const auto known = d.find(info);
    if (!known) continue;
    d.groups[*known]->describe(info);
  }
  d.revision.fetch_add(1);
}

void SeriesStore::append(GroupId id, const RowView& row) {
  Impl& d = *m_impl;
  series::Group* const group = d.writable(id);
  auto done = group ? group->put(row) : series::Group::Put::Refused;
  if (done == series::Group::Put::GoesBack) {
    const std::lock_guard lock(d.structure);
    group->truncate(row.time);
    d.account();
    done = group->put(row);
  }
  if (done == series::Group::Put::BlockFull) {
    const std::lock_guard lock(d.structure);
    group->closeBlock();
    d.keepBudget();
  }
  if (done != series::Group::Put::Refused && d.listener && !d.isTold.exchange(true)) d.listener();
}

void SeriesStore::setListener(std::function<void()> listener) {
  m_impl->listener = std::move(listener);
}

void SeriesStore::heard() const {
  m_impl->isTold.store(false);
}

void SeriesStore::clear() {
  const std::lock_guard lock(m_impl->structure);
  for (const auto& group : m_impl->groups) group->clear();
  m_impl->account();
}

void SeriesStore::rewind(double time) {
  const std::lock_guard lock(m_impl->structure);
  const double next = std::nextafter(time, std::numeric_limits<double>::infinity());
  for (const auto& group : m_impl->groups) group->truncate(next);
  m_impl->account();
}

std::shared_ptr<const SeriesStore> SeriesStore::branch() const {
  auto copy = std::make_shared<SeriesStore>(SeriesOptions{m_impl->budget.load()});
  const std::lock_guard structure(m_impl->structure);
  const std::shared_lock list(m_impl->listMutex);
  for (const auto& group : m_impl->groups) copy->m_impl->groups.push_back(group->branch());
  copy->m_impl->pages = m_impl->pages;
  copy->m_impl->revision = m_impl->revision.load();
  copy->m_impl->account();
  return copy;
}

std::uint64_t SeriesStore::groupsRevision() const {
  return m_impl->revision.load();
}

std::size_t SeriesStore::groups() const {
  const std::shared_lock lock(m_impl->listMutex);
  return m_impl->groups.size();
}

std::shared_ptr<const GroupView> SeriesStore::view(GroupId id) const {
  const std::shared_lock lock(m_impl->listMutex);
  if (id >= m_impl->groups.size()) return nullptr;
  if (m_impl->pages) return pagedView(m_impl->groups[id]->view(), id, m_impl->pages);
  return m_impl->groups[id]->view();
}

Result<std::vector<GroupId>> SeriesStore::groupsNamed(std::string_view name) const {
  const std::shared_lock lock(m_impl->listMutex);
  std::vector<std::shared_ptr<const GroupView>> views;
  std::vector<const GroupInfo*> infos;
  for (const auto& group : m_impl->groups) {
    views.push_back(group->view());
    infos.push_back(&views.back()->info());
  }
  return telemetry::groupsNamed(name, infos);
}

std::optional<GroupId> SeriesStore::findGroup(std::string_view name) const {
  const auto found = groupsNamed(name);
  return found ? std::optional(found->front()) : std::nullopt;
}

std::vector<std::string> SeriesStore::groupNames() const {
  std::vector<std::string> names;
  const std::shared_lock lock(m_impl->listMutex);
  for (GroupId id = 0; id < m_impl->groups.size(); ++id) {
    names.push_back(m_impl->groups[id]->view()->info().name);
  }
  return names;
}

std::optional<SeriesId> SeriesStore::find(std::string_view group, std::string_view column) const {
  const auto groups = groupsNamed(group);
  for (const GroupId id : groups.value_or(std::vector<GroupId>())) {
    const auto found = view(id);
    const auto& columns = found->info().columns;
    const auto at = std::ranges::find(columns, column, &ColumnInfo::name);
    if (at != columns.end()) return SeriesId{id, static_cast<std::uint32_t>(at - columns.begin())};
  }
  return std::nullopt;
}

std::optional<TimeRange> SeriesStore::range() const {
  std::optional<TimeRange> out;
  const std::shared_lock lock(m_impl->listMutex);
  if (m_impl->pages) return m_impl->pages->range();
  for (const auto& group : m_impl->groups) {
    const auto one = group->view()->range();
    if (!one) continue;
    if (!out) out = one;
    out->begin = std::min(out->begin, one->begin);
    out->end = std::max(out->end, one->end);
  }
  return out;
}

void SeriesStore::setPages(std::shared_ptr<SeriesPages> pages) {
  const std::lock_guard lock(m_impl->listMutex);
  m_impl->pages = std::move(pages);
  m_impl->revision.fetch_add(1);
}

std::uint64_t SeriesStore::pagesRevision() const {
  const std::shared_lock lock(m_impl->listMutex);
  return m_impl->pages ? m_impl->pages->revision() : 0;
}

std::size_t SeriesStore::memoryBytes() const {
  {
    const std::shared_lock lock(m_impl->listMutex);
    if (m_impl->pages) return m_impl->pages->bytes();
  }
  return m_impl->bytes.load(std::memory_order_relaxed);
}

void SeriesStore::setMemoryBudget(std::size_t bytes) {
  // The list may grow meanwhile (addGroup takes this lock too), never shrink.
  const std::lock_guard lock(m_impl->structure);
  m_impl->budget.store(bytes, std::memory_order_relaxed);
  m_impl->keepBudget();
}

}  // namespace pitchboard::telemetry
