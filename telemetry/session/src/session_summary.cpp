// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_summary.h"

#include <algorithm>
#include <limits>

#include <telemetry/session/session_reader.h>

#include "session_reader_impl.h"

namespace pitchboard::telemetry {

bool SessionReader::hasSummaries() const {
  return !m_impl->summaryChannels.empty();
}

GroupSummary SessionReader::summary(GroupId group, const std::function<bool()>& goOn) const {
  GroupSummary out = m_impl->writtenSummary(group, goOn);
  if (complete() || !hasSummaries()) return out;
  if (m_impl->rest.empty() && !m_impl->summarizeRest(*this, goOn)) return {};
  const auto& rest = m_impl->rest[group];
  out.parts.insert(out.parts.end(), rest.begin(), rest.end());
  return out;
}

/// What the recording would have written at its end, had it come to it.
bool SessionReader::Impl::summarizeRest(const SessionReader& session,
                                        const std::function<bool()>& goOn) const {
  std::vector<double> ends;
  std::vector<SummaryBuilder> builders;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary written = writtenSummary(static_cast<GroupId>(g), goOn);
    ends.push_back(written.parts.empty() ? -1e18 : written.parts.back().end.back());
    builders.emplace_back(groups[g].info);
  }
  std::vector<std::vector<SummaryPart>> parts(groups.size());
  const bool whole = session.walkRows(
      {std::ranges::min(ends), 1e18},
      [&](const SessionItem& item) {
        // Times of parts are those of the file, which may be a rounding off those of the row.
        if (item.time <= ends[item.group] + 1e-6) return true;
        if (auto part = builders[item.group].add(item.time, item.row)) {
          parts[item.group].push_back(std::move(*part));
        }
        return true;
      },
      [&](double) { return !goOn || goOn(); });
  if (!whole) return false;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (auto part = builders[g].finish()) parts[g].push_back(std::move(*part));
  }
  rest = std::move(parts);
  return true;
}

namespace {

/// A part with the columns of the whole group.
SummaryPart widened(SummaryPart part, const RowMap& map, std::size_t columns) {
  if (map.isIdentity()) return part;
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  std::vector<SummaryPart::Column> all(columns, {{nothing}, {nothing}, {nothing}});
  for (std::size_t c = 0; c < part.columns.size(); ++c) {
    if (map.columns()[c] < columns) all[map.columns()[c]] = std::move(part.columns[c]);
  }
  part.columns = std::move(all);
  return part;
}

/// The buckets of one part that begin in this range of times.
SummaryPart cut(const SummaryPart& part, double begin, double end) {
  SummaryPart out;
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < part.buckets(); ++i) {
    if (part.begin[i] < begin || part.begin[i] >= end) continue;
    out.begin.push_back(part.begin[i]);
    out.end.push_back(part.end[i]);
    out.rows.push_back(part.rows[i]);
    taken.push_back(i);
  }
  const auto take = [&taken](const std::vector<float>& from, std::vector<float>& to) {
    if (from.size() == 1) {
      to = from;
      return;
    }
    for (const std::size_t bucket : taken) to.push_back(from[bucket]);
  };
  for (const SummaryPart::Column& column : part.columns) {
    SummaryPart::Column& to = out.columns.emplace_back();
    take(column.min, to.min);
    take(column.max, to.max);
    take(column.last, to.last);
  }
  return out;
}

/// Puts parts in order of time. Rows of a group whose columns change go now into one channel, now
/// into another, and a part of one channel can span several of the other.
std::vector<SummaryPart> ordered(std::vector<SummaryPart> parts) {
  const auto begin = [](const SummaryPart& part) { return part.begin.front(); };
  std::ranges::stable_sort(parts, {}, begin);
  std::vector<SummaryPart> out;
  double end = -1e18;  // of what is in `out`
  while (!parts.empty()) {
    SummaryPart first = std::move(parts.front());
    parts.erase(parts.begin());
    if (first.begin.front() < end) {
      first = cut(first, end, 1e18);
      if (first.buckets() == 0) continue;
      const auto at = std::ranges::upper_bound(parts, begin(first), {}, begin);
      parts.insert(at, std::move(first));
      continue;
    }
    const double next = parts.empty() ? 1e18 : begin(parts.front());
    if (first.end.back() > next && first.begin.front() < next) {
      SummaryPart rest = cut(first, next, 1e18);
      first = cut(first, -1e18, next);
      // Version 0.21 continued a bucket after rows of another channel.
      first.end.back() = std::min(first.end.back(), next);
      if (rest.buckets() > 0) {
        parts.insert(std::ranges::upper_bound(parts, begin(rest), {}, begin), std::move(rest));
      }
    }
    end = first.end.back();
    out.push_back(std::move(first));
  }
  return out;
}

}  // namespace

/// The parts that stand in the file.
GroupSummary SessionReader::Impl::writtenSummary(GroupId group,
                                                 const std::function<bool()>& goOn) const {
  GroupSummary out;
  const Impl& impl = *this;
  const auto known = impl.summaryChannels.find(group);
  if (known == impl.summaryChannels.end()) return out;
  const auto& channels = known->second;
  const std::size_t columns = impl.groups[group].info.columns.size();
  for (std::size_t i = 0; i < impl.file.contents().chunks.size(); ++i) {
    const McapChunkInfo& chunk = impl.file.contents().chunks[i];
    if (std::ranges::none_of(channels,
                             [&](const auto& one) { return Impl::mayHold(chunk, one.first); })) {
      continue;
    }
    if (goOn && !goOn()) return {};
    McapCursor cursor(impl.body(i));
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message) continue;
      const auto of = channels.find(cursor.message().channel);
      if (of == channels.end()) continue;
      const RowMap& map = impl.maps[of->second];
      if (auto part = session::summaryFromBytes(cursor.message().data, map.columns().size())) {
        out.parts.push_back(widened(std::move(*part), map, columns));
      }
    }
  }
  out.parts = ordered(std::move(out.parts));
  return out;
}

}  // namespace pitchboard::telemetry
