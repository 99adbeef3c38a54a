// SPDX-License-Identifier: GPL-3.0-or-later
// Rows and messages of a session: of a moment, and of a range in the order of time.

#include <algorithm>
#include <limits>

#include <telemetry/mcap/mcap_cursor.h>

#include "session_reader_impl.h"

namespace pitchboard::telemetry {

void SessionReader::rowsAt(double time, std::vector<SessionRow>& out) const {
  const Impl& impl = *m_impl;
  out.resize(impl.groups.size());
  for (SessionRow& row : out) row.present = false;
  const std::uint64_t until = logTime(time);
  std::vector<std::uint64_t> best(impl.groups.size(), 0);
  std::vector<std::string_view> found(impl.groups.size());
  const auto& chunks = impl.file.contents().chunks;
  auto at =
      static_cast<std::size_t>(std::upper_bound(impl.byStart.begin(), impl.byStart.end(), until,
                                                [&](std::uint64_t value, std::size_t chunk) {
                                                  return value < chunks[chunk].start;
                                                }) -
                               impl.byStart.begin());
  while (at-- > 0) {
    const McapChunkInfo& chunk = chunks[impl.byStart[at]];
    bool needed = false, settled = true;
    for (std::size_t g = 0; g < impl.groups.size(); ++g) {
      const bool done = out[g].present && best[g] > impl.latestEnd[at];
      if (done) continue;
      settled = false;
      needed = needed || (std::ranges::any_of(impl.groups[g].channels,
                                              [&](std::uint16_t channel) {
                                                return Impl::mayHold(chunk, channel);
                                              }) &&
                          (!out[g].present || best[g] <= chunk.end));
    }
    if (settled) break;
    if (!needed) continue;
    std::fill(found.begin(), found.end(), std::string_view());
    McapCursor cursor(impl.body(impl.byStart[at]));
    std::vector<McapMessage> last(impl.groups.size());
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message || cursor.message().logTime > until) continue;
      const int group = impl.useOf(cursor.message().channel).group;
      if (group == Impl::noGroup) continue;
      const auto g = static_cast<std::size_t>(group);
      if (cursor.message().logTime < best[g] ||
          (out[g].present && found[g].empty() && cursor.message().logTime == best[g])) {
        continue;
      }
      best[g] = cursor.message().logTime;
      found[g] = cursor.message().data;
      last[g] = cursor.message();
    }
    for (std::size_t g = 0; g < impl.groups.size(); ++g) {
      if (found[g].empty() || !impl.readRow(impl.useOf(last[g].channel), found[g], out[g])) {
        continue;
      }
      out[g].time = Impl::time(out[g].time, last[g]);
      out[g].channel = last[g].channel;
      out[g].present = true;
    }
  }
}

TimeOrder SessionReader::Impl::inOrder() const {
  return {file.contents().chunks, [this](std::size_t chunk) { return hold(chunk); }};
}

bool SessionReader::Impl::walk(std::uint64_t begin, std::uint64_t end,
                               const std::vector<std::uint16_t>& wanted,
                               const std::function<bool(const SessionItem&)>& visit,
                               const std::function<bool(double)>& progress) const {
  const TimeOrder::Wanted part{
      begin, end,
      [&](const McapChunkInfo& chunk) {
        return std::ranges::any_of(wanted,
                                   [&](std::uint16_t channel) { return mayHold(chunk, channel); });
      },
      [&](std::uint16_t channel) { return std::ranges::binary_search(wanted, channel); }};
  SessionItem item;
  SessionRow row;
  return inOrder().walk(
      part,
      [&](const McapMessage& message) {
        const Use use = useOf(message.channel);
        item.message = &message;
        item.isRow = use.group != noGroup;
        if (item.isRow) {
          const auto g = static_cast<std::size_t>(use.group);
          if (!readRow(use, message.data, row)) return true;
          row.time = item.time = time(row.time, message);
          item.group = static_cast<GroupId>(g);
          item.row = row.view();
        } else {
          const auto source = session::timeFromJson(message.data);
          if (!source) return true;
          item.time = time(*source, message);
          item.stream = use.stream;
        }
        return visit(item);
      },
      progress);
}

/// In order; rows of all groups when `groups` is empty.
std::vector<std::uint16_t> SessionReader::Impl::channelsOf(
    std::span<const GroupId> wanted, std::span<const SessionStream> streams) const {
  std::vector<std::uint16_t> out;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!wanted.empty() && std::ranges::find(wanted, g) == wanted.end()) continue;
    out.insert(out.end(), groups[g].channels.begin(), groups[g].channels.end());
  }
  for (const SessionStream stream : streams) {
    const auto& channels = channelsOfStream[static_cast<std::size_t>(stream)];
    out.insert(out.end(), channels.begin(), channels.end());
  }
  std::ranges::sort(out);
  return out;
}

bool SessionReader::walk(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
                         const std::function<bool(double)>& progress) const {
  std::array<SessionStream, sessionStreamCount> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<SessionStream>(i);
  return m_impl->walk(logTime(range.begin), logTime(range.end), m_impl->channelsOf({}, all), visit,
                      progress);
}

bool SessionReader::walkRows(TimeRange range, const std::function<bool(const SessionItem&)>& visit,
                             const std::function<bool(double)>& progress) const {
  return m_impl->walk(logTime(range.begin), logTime(range.end), m_impl->channelsOf({}, {}), visit,
                      progress);
}

bool SessionReader::walkFile(TimeRange range, const std::function<bool(const McapMessage&)>& visit,
                             const std::function<bool(double)>& progress) const {
  const std::uint64_t begin = range.begin <= -1e18 ? 0 : logTime(range.begin);
  const std::uint64_t end =
      range.end >= 1e18 ? std::numeric_limits<std::uint64_t>::max() : logTime(range.end);
  const auto all = [](const auto&) { return true; };
  return m_impl->inOrder().walk({begin, end, all, all}, visit, progress);
}

void SessionReader::rows(TimeRange range, std::span<const GroupId> groups,
                         const std::function<bool(GroupId, const RowView&)>& visit) const {
  m_impl->walk(logTime(range.begin), logTime(range.end), m_impl->channelsOf(groups, {}),
               [&](const SessionItem& item) { return visit(item.group, item.row); }, {});
}

void SessionReader::messages(SessionStream stream, TimeRange range,
                             const std::function<bool(double, std::string_view)>& visit) const {
  messages(std::span(&stream, 1), range,
           [&](SessionStream, double time, std::string_view json) { return visit(time, json); });
}

void SessionReader::messages(
    std::span<const SessionStream> streams, TimeRange range,
    const std::function<bool(SessionStream, double time, std::string_view json)>& visit) const {
  std::vector<std::uint16_t> wanted;
  for (const SessionStream stream : streams) {
    const auto& channels = m_impl->channelsOfStream[static_cast<std::size_t>(stream)];
    wanted.insert(wanted.end(), channels.begin(), channels.end());
  }
  std::ranges::sort(wanted);
  m_impl->walk(
      logTime(range.begin), logTime(range.end), wanted,
      [&](const SessionItem& item) { return visit(item.stream, item.time, item.message->data); },
      {});
}

namespace {

/// A bookmark is recorded when it is set, and again with its note: keeps the last of each time.
std::vector<SessionEvent> withoutOldNotes(std::vector<SessionEvent> events) {
  constexpr double sameTime = 1e-6;  // s; files keep whole nanoseconds
  std::vector<SessionEvent> kept;
  kept.reserve(events.size());
  for (SessionEvent& event : events) {
    if (event.kind == session::bookmarkKind) {
      const auto same = std::find_if(kept.rbegin(), kept.rend(), [&event](const auto& before) {
        return before.kind == session::bookmarkKind || event.time - before.time > sameTime;
      });
      if (same != kept.rend() && same->kind == session::bookmarkKind &&
          event.time - same->time <= sameTime) {
        *same = std::move(event);
        continue;
      }
    }
    kept.push_back(std::move(event));
  }
  return kept;
}

}  // namespace

std::vector<SessionEvent> SessionReader::events() const {
  std::vector<SessionEvent> out;
  const auto all = range();
  if (!all) return out;
  messages(SessionStream::Events, *all, [&](double time, std::string_view json) {
    if (auto event = session::eventFromJson(json)) {
      event->time = time;
      out.push_back(std::move(*event));
    }
    return true;
  });
  out.insert(out.end(), addedNotes().begin(), addedNotes().end());
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return withoutOldNotes(std::move(out));
}

}  // namespace pitchboard::telemetry
