// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_summary.h"

#include <cmath>
#include <cstring>

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

std::optional<SummaryPart> summaryFromBytes(std::string_view bytes, std::size_t columns) {
  ByteReader in(bytes);
  if (in.number<std::uint8_t>() != version) return std::nullopt;
  const std::size_t buckets = in.number<std::uint8_t>();
  if (buckets == 0 || buckets > SummaryPart::mostBuckets ||
      in.number<std::uint32_t>() != columns) {
    return std::nullopt;
  }
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
  return part;
}

}  // namespace session

bool SessionReader::hasSummaries() const {
  return complete() && !m_impl->summaryChannels.empty();
}

GroupSummary SessionReader::summary(GroupId group, const std::function<bool()>& goOn) const {
  GroupSummary out;
  const Impl& impl = *m_impl;
  const auto channel = impl.summaryChannels.find(group);
  if (channel == impl.summaryChannels.end()) return out;
  const std::size_t columns = impl.groups[group].info.columns.size();
  for (std::size_t i = 0; i < impl.file.chunks().size(); ++i) {
    const McapChunkInfo& chunk = impl.file.chunks()[i];
    if (!Impl::mayHold(chunk, channel->second)) continue;
    if (goOn && !goOn()) return {};
    McapCursor cursor(impl.body(i));
    for (auto kind = cursor.next(); kind != McapCursor::Kind::End; kind = cursor.next()) {
      if (kind != McapCursor::Kind::Message || cursor.message().channel != channel->second) continue;
      auto part = session::summaryFromBytes(cursor.message().data, columns);
      const bool follows = part && (out.parts.empty() ||
                                    out.parts.back().end.back() <= part->begin.front());
      if (follows) out.parts.push_back(std::move(*part));
    }
  }
  return out;
}

}  // namespace pitchboard::telemetry
