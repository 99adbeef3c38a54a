// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of summaries. Apart from the reader, because pitchboard-agent needs no reader.
#include <cstring>
#include <limits>

#include <base/byte_reader.h>

#include "session_summary.h"

namespace pitchboard::telemetry::session {
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
  if (buckets == 0 || buckets > SummaryPart::maxBuckets || columns > most) return std::nullopt;
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

}  // namespace pitchboard::telemetry::session
