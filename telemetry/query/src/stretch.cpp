// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/stretch.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <base/try.h>

namespace pitchboard::telemetry {

Result<std::vector<StretchCurve>> readStretch(const QueryRows& rows, const QueryTexts& texts,
                                              std::span<const TimeRange> ranges,
                                              const std::function<bool(double)>& progress) {
  SessionQuery query = TRY(SessionQuery::of(rows, texts));
  std::vector<StretchCurve> out;
  for (const QueryCurve& curve : query.curves()) out.push_back({curve, {}, {}});
  if (ranges.empty()) return out;
  auto range = ranges.begin();
  const bool whole = query.run(
      rows, {ranges.front().begin, ranges.back().end},
      [&](const QuerySample& sample) {
        while (range != ranges.end() && range->end < sample.time) ++range;
        const bool isInside = range != ranges.end() && range->begin <= sample.time;
        const bool counts = isInside && sample.isConditioned;
        StretchCurve& curve = out[sample.curve];
        curve.samples.push_back({sample.time, counts ? sample.value : std::nan("")});
        curve.counted.push_back(counts);
        return true;
      },
      progress);
  if (!whole) return failure(ErrorCode::Conflict, "Stopped.");
  return out;
}

namespace {

bool fitsEvent(const SessionEvent& event, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (event.kind != text.substr(0, colon)) return false;
  return colon == std::string::npos ||
         (event.facts && event.facts->detail == text.substr(colon + 1));
}

}  // namespace

Result<std::vector<TimeRange>> rangesBetween(std::span<const SessionEvent> events,
                                             std::optional<double> end, const std::string& first,
                                             const std::string& last) {
  for (const std::string& wanted : {first, last}) {
    if (std::ranges::any_of(events, [&](const auto& event) { return fitsEvent(event, wanted); })) {
      continue;
    }
    std::set<std::string> kinds;
    for (const SessionEvent& event : events) kinds.insert(event.kind);
    std::string known;
    for (const std::string& kind : kinds) known += (known.empty() ? "" : ", ") + kind;
    return failure(ErrorCode::NotFound, "There is no event \"" + wanted + "\"; there are: " +
                                            (known.empty() ? "none" : known) + ".");
  }
  std::vector<TimeRange> out;
  std::optional<double> begin;
  for (const SessionEvent& event : events) {
    // An event ends one range before it may begin the next.
    if (begin && event.time > *begin && fitsEvent(event, last)) {
      out.push_back({*begin, event.time});
      begin.reset();
    }
    if (!begin && fitsEvent(event, first)) begin = event.time;
  }
  if (begin && end && *end > *begin) out.push_back({*begin, *end});
  return out;
}

Result<std::vector<TimeRange>> rangesBetween(const SessionReader& session, const std::string& first,
                                             const std::string& last) {
  const auto all = session.range();
  return rangesBetween(session.events(), all ? std::optional(all->end) : std::nullopt, first, last);
}

}  // namespace pitchboard::telemetry
