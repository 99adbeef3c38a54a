// SPDX-License-Identifier: GPL-3.0-or-later
#include "time_order.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include <telemetry/mcap/mcap_cursor.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();

}  // namespace

bool TimeOrder::walk(const Wanted& wanted, const std::function<bool(const McapMessage&)>& visit,
                     const std::function<bool(double)>& progress) {
  constexpr Key never{std::numeric_limits<std::uint64_t>::max(), endless, endless};
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < m_chunks.size(); ++i) {
    const McapChunkInfo& chunk = m_chunks[i];
    if (chunk.end >= wanted.begin && chunk.start <= wanted.end && wanted.chunk(chunk)) {
      order.push_back(i);
    }
  }
  std::ranges::stable_sort(order, {}, [this](std::size_t i) { return m_chunks[i].start; });
  m_from = {wanted.begin, 0, 0};
  const auto total = static_cast<double>(order.size());
  while (!order.empty()) {
    m_dropped = never;
    const double done = 1.0 - static_cast<double>(order.size()) / total;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Key first{m_chunks[order[i]].start, order[i], 0};
      if (first >= m_dropped) break;
      if (progress && !progress(done + static_cast<double>(i) / total)) return false;
      if (!visitUntil(first, visit)) return false;
      load(order[i], wanted);
      if (m_heldBytes > m_memory) dropLatest();
    }
    if (!visitUntil(m_dropped, visit)) return false;
    m_from = m_dropped;
    std::erase_if(order, [this](std::size_t i) {
      return Key{m_chunks[i].end, i, endless} < m_from;
    });
  }
  return true;
}

void TimeOrder::load(std::size_t chunk, const Wanted& wanted) {
  const auto body = m_body(chunk);
  if (!body) return;
  m_waiting.erase(m_waiting.begin(), m_waiting.begin() + static_cast<std::ptrdiff_t>(m_next));
  m_next = 0;
  const std::size_t known = m_waiting.size();
  bool isOrdered = true;
  McapCursor cursor(*body);
  for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
    if (kind != McapCursor::Kind::Message) continue;
    const McapMessage& message = cursor.message();
    const Key key{message.logTime, chunk, cursor.start()};
    if (key < m_from || key >= m_dropped || message.logTime > wanted.end ||
        !wanted.channel(message.channel)) {
      continue;
    }
    isOrdered = isOrdered && (m_waiting.size() == known || m_waiting.back().key < key);
    m_waiting.push_back({key, key.offset, message.sequence, message.channel});
  }
  if (m_waiting.size() == known) return;
  m_held[chunk] = {body, m_waiting.size() - known};
  m_heldBytes += body->size();
  const auto middle = m_waiting.begin() + static_cast<std::ptrdiff_t>(known);
  if (!isOrdered) {
    m_isMixed = true;
    std::sort(middle, m_waiting.end(),
              [](const Entry& a, const Entry& b) { return a.key < b.key; });
  }
  std::inplace_merge(m_waiting.begin(), middle, m_waiting.end(),
                     [](const Entry& a, const Entry& b) { return a.key < b.key; });
}

std::size_t TimeOrder::bytesOf(const Entry& entry) const {
  McapCursor cursor(std::string_view(*m_held.at(entry.key.chunk).bytes).substr(entry.at));
  (void)cursor.next();
  return cursor.offset();
}

/// Keeps a copy of the earliest messages, up to half of the memory, and at least one.
void TimeOrder::dropLatest() {
  std::map<std::size_t, std::shared_ptr<std::string>> copies;
  std::size_t bytes = 0, i = m_next;
  for (; i < m_waiting.size(); ++i) {
    Entry& entry = m_waiting[i];
    const std::size_t size = bytesOf(entry);
    if (i > m_next && bytes + size > m_memory / 2) break;
    auto& copy = copies[entry.key.chunk];
    if (!copy) copy = std::make_shared<std::string>();
    const std::size_t at = copy->size();
    copy->append(*m_held.at(entry.key.chunk).bytes, entry.at, size);
    entry.at = at;
    bytes += size;
  }
  if (i < m_waiting.size()) m_dropped = m_waiting[i].key;
  m_waiting.resize(i);
  m_held.clear();
  for (auto& [chunk, copy] : copies) m_held[chunk].bytes = std::move(copy);
  for (i = m_next; i < m_waiting.size(); ++i) ++m_held[m_waiting[i].key.chunk].entries;
  m_heldBytes = bytes;
}

/// Puts messages of one channel and one time, which a file may hold backwards, in their order.
void TimeOrder::bySequence(std::size_t begin, std::size_t end) {
  std::vector<Entry> sorted;
  std::vector<std::size_t> places;
  for (std::size_t first = begin, last = begin; first < end; first = last) {
    while (last < end && m_waiting[last].key.time == m_waiting[first].key.time) ++last;
    if (last - first < 2) continue;
    sorted.assign(m_waiting.begin() + static_cast<std::ptrdiff_t>(first),
                  m_waiting.begin() + static_cast<std::ptrdiff_t>(last));
    places.resize(last - first);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = first + i;
    std::ranges::stable_sort(places, {}, [this](std::size_t i) { return m_waiting[i].channel; });
    std::ranges::stable_sort(sorted, [](const Entry& a, const Entry& b) {
      return std::tie(a.channel, a.sequence) < std::tie(b.channel, b.sequence);
    });
    for (std::size_t i = 0; i < places.size(); ++i) m_waiting[places[i]] = sorted[i];
  }
}

bool TimeOrder::visitUntil(const Key& limit, const std::function<bool(const McapMessage&)>& visit) {
  const auto next = m_waiting.begin() + static_cast<std::ptrdiff_t>(m_next);
  const auto end = static_cast<std::size_t>(
      std::ranges::lower_bound(next, m_waiting.end(), limit, {}, &Entry::key) - m_waiting.begin());
  if (m_isMixed) bySequence(m_next, end);
  while (m_next < end) {
    const Entry entry = m_waiting[m_next++];
    const auto held = m_held.find(entry.key.chunk);
    McapCursor cursor(std::string_view(*held->second.bytes).substr(entry.at));
    const bool goesOn = cursor.next() == McapCursor::Kind::Message && visit(cursor.message());
    if (--held->second.entries == 0) {
      m_heldBytes -= held->second.bytes->size();
      m_held.erase(held);
    }
    if (!goesOn) return false;
  }
  return true;
}

}  // namespace pitchboard::telemetry
