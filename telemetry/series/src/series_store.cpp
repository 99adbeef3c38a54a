// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/series_store.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <shared_mutex>

#include <telemetry/series/series_pages.h>

#include "series_group.h"

namespace pitchboard::telemetry {

struct SeriesStore::Impl {
  // Taken by a writer every 64 rows, and by whoever changes groups or budget: chunks come and go.
  std::mutex structure;
  // Of the list below, which only grows, and only under `structure`.
  mutable std::shared_mutex listMutex;
  std::vector<std::unique_ptr<series::Group>> groups;
  std::vector<bool> replaced;  // by a group of the same name with other columns
  std::atomic<std::uint64_t> revision{0}, refused{0};
  std::atomic<std::size_t> bytes{0}, budget{0};
  std::shared_ptr<SeriesPages> pages;                     // of the list's mutex
  std::map<std::string, GroupId, std::less<>> wasCalled;  // of the list's mutex

  static constexpr std::size_t mostNames = 10'000;

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
    return id < groups.size() && !replaced[id] ? groups[id].get() : nullptr;
  }

  /// Under one of the locks.
  std::optional<GroupId> find(std::string_view name) const {
    for (GroupId id = 0; id < groups.size(); ++id) {
      if (!replaced[id] && groups[id]->view()->info().name == name) return id;
    }
    return std::nullopt;
  }
};

namespace {

/// The same columns in the same places, and perhaps further values behind them.
bool continues(const std::vector<ColumnInfo>& before, const std::vector<ColumnInfo>& now) {
  if (now.size() < before.size()) return false;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const bool same = i < before.size()
                          ? now[i].name == before[i].name && now[i].type == before[i].type &&
                                now[i].lost == before[i].lost
                          : now[i].type == ColumnType::Float64;
    if (!same) return false;
  }
  return true;
}

}  // namespace

SeriesStore::SeriesStore(SeriesOptions options) : m_impl(std::make_unique<Impl>()) {
  m_impl->budget = options.memoryBudget;
}

SeriesStore::~SeriesStore() = default;

GroupId SeriesStore::addGroup(const GroupInfo& info) {
  return renameGroup(info.name, info);
}

GroupId SeriesStore::renameGroup(std::string_view from, const GroupInfo& info) {
  Impl& d = *m_impl;
  auto layout = std::make_shared<const series::Layout>(info);
  const std::lock_guard structure(d.structure);
  auto known = d.find(info.name);
  if (!known) known = d.find(from);
  if (known) {
    series::Group& group = *d.groups[*known];
    const auto view = group.view();
    if (continues(view->info().columns, info.columns)) {
      if (view->info() == info) return *known;
      if (info.columns.size() == view->info().columns.size()) {
        group.setLayout(std::move(layout));
      } else {
        group.widen(std::move(layout));
        d.account();
      }
      if (view->info().name != info.name) {
        const std::lock_guard list(d.listMutex);
        if (d.wasCalled.size() < Impl::mostNames) d.wasCalled[view->info().name] = *known;
      }
      d.revision.fetch_add(1);
      return *known;
    }
    group.clear();
  }
  auto group = std::make_unique<series::Group>(std::move(layout));
  const std::lock_guard list(d.listMutex);
  if (known) d.replaced[*known] = true;
  d.groups.push_back(std::move(group));
  d.replaced.push_back(false);
  d.account();
  d.revision.fetch_add(1);
  return static_cast<GroupId>(d.groups.size() - 1);
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
  if (done == series::Group::Put::Refused) d.refused.fetch_add(1, std::memory_order_relaxed);
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
  copy->m_impl->replaced = m_impl->replaced;
  copy->m_impl->wasCalled = m_impl->wasCalled;
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

std::optional<GroupId> SeriesStore::findGroup(std::string_view name) const {
  const std::shared_lock lock(m_impl->listMutex);
  return m_impl->find(name);
}

std::optional<SeriesId> SeriesStore::find(std::string_view group, std::string_view column) const {
  auto id = findGroup(group);
  if (!id) {
    const std::shared_lock lock(m_impl->listMutex);
    const auto before = m_impl->wasCalled.find(group);
    if (before == m_impl->wasCalled.end()) return std::nullopt;
    id = before->second;
  }
  const auto found = view(*id);
  if (!found) return std::nullopt;
  const auto& columns = found->info().columns;
  const auto at = std::ranges::find(columns, column, &ColumnInfo::name);
  if (at == columns.end()) return std::nullopt;
  return SeriesId{*id, static_cast<std::uint32_t>(at - columns.begin())};
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

std::uint64_t SeriesStore::refusedRows() const {
  return m_impl->refused.load(std::memory_order_relaxed);
}

void SeriesStore::setMemoryBudget(std::size_t bytes) {
  // The list may grow meanwhile (addGroup takes this lock too), never shrink.
  const std::lock_guard lock(m_impl->structure);
  m_impl->budget.store(bytes, std::memory_order_relaxed);
  m_impl->keepBudget();
}

}  // namespace pitchboard::telemetry
