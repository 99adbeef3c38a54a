// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_summary.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <base/byte_reader.h>
#include <telemetry/session/session_reader.h>

#include "session_reader_impl.h"

namespace pitchboard::telemetry {
namespace session {
namespace {

constexpr std::uint8_t version = 1;

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

template <class T>
void put(std::string& out, const std::vector<T>& values) {
  for (const T value : values) put(out, value);
}

template <class T>
void take(ByteReader& in, std::size_t count, std::vector<T>& out) {
  out.clear();
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) out.push_back(in.number<T>());
}

}  // namespace

std::string summaryBytes(const SummaryPart& part) {
  std::string out;
  put(out, version);
  put(out, static_cast<std::uint8_t>(part.buckets()));
  put(out, static_cast<std::uint32_t>(part.columns.size()));
  put(out, part.begin);
  put(out, part.end);
  put(out, part.rows);
  for (const SummaryPart::Column& column : part.columns) {
    for (const auto* values : {&column.min, &column.max, &column.last}) {
      put(out, static_cast<std::uint8_t>(values->size()));
      put(out, *values);
    }
  }
  return out;
}

std::optional<SummaryPart> summaryFromBytes(std::string_view bytes, std::size_t most) {
  ByteReader in(bytes);
  if (in.number<std::uint8_t>() != version) return std::nullopt;
  const std::size_t buckets = in.number<std::uint8_t>();
  const std::size_t columns = in.number<std::uint32_t>();
  if (buckets == 0 || buckets > SummaryPart::mostBuckets || columns > most) return std::nullopt;
  SummaryPart part;
  take(in, buckets, part.begin);
  take(in, buckets, part.end);
  take(in, buckets, part.rows);
  double before = -1e18;
  for (std::size_t i = 0; i < buckets; ++i) {
    if (!(part.begin[i] >= before) || !(part.end[i] >= part.begin[i]) || !(part.end[i] < 1e18)) {
      return std::nullopt;
    }
    before = part.end[i];
  }
  part.columns.resize(columns);
  for (SummaryPart::Column& column : part.columns) {
    for (auto* values : {&column.min, &column.max, &column.last}) {
      const std::size_t count = in.number<std::uint8_t>();
      if (count != 1 && count != buckets) return std::nullopt;
      take(in, count, *values);
    }
  }
  if (!in.ok() || in.left() != 0) return std::nullopt;
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  part.columns.resize(most, {{nothing}, {nothing}, {nothing}});
  return part;
}

}  // namespace session

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

/// The parts that stand in the file.
GroupSummary SessionReader::Impl::writtenSummary(GroupId group,
                                                 const std::function<bool()>& goOn) const {
  GroupSummary out;
  const Impl& impl = *this;
  const auto known = impl.summaryChannels.find(group);
  if (known == impl.summaryChannels.end()) return out;
  const std::vector<std::uint16_t>& channels = known->second;
  const std::size_t columns = impl.groups[group].info.columns.size();
  for (std::size_t i = 0; i < impl.file.contents().chunks.size(); ++i) {
    const McapChunkInfo& chunk = impl.file.contents().chunks[i];
    if (std::ranges::none_of(channels, [&](auto id) { return Impl::mayHold(chunk, id); })) continue;
    if (goOn && !goOn()) return {};
    McapCursor cursor(impl.body(i));
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message ||
          std::ranges::find(channels, cursor.message().channel) == channels.end()) {
        continue;
      }
      if (auto part = session::summaryFromBytes(cursor.message().data, columns)) {
        out.parts.push_back(std::move(*part));
      }
    }
  }
  // The rest of a channel stands at the end, also where another one has followed it.
  const auto begin = [](const SummaryPart& part) { return part.begin.front(); };
  std::ranges::stable_sort(out.parts, {}, begin);
  double end = -1e18;
  std::erase_if(out.parts, [&end](const SummaryPart& part) {
    if (part.begin.front() < end) return true;
    end = part.end.back();
    return false;
  });
  return out;
}

}  // namespace pitchboard::telemetry
