// SPDX-License-Identifier: GPL-3.0-or-later
#include "possible_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "comparisons.h"

namespace pitchboard::telemetry {
namespace {

constexpr double timeRounding = 1e-6;  // s; summaries have the times of the file

/// Whether a value between these can hold. They are in single precision, and values of the column
/// may be rounded to `resolution` in the rows.
bool canHold(const Limit& limit, float least, float most, double resolution) {
  if (std::isnan(least) || std::isnan(most)) return false;  // every value is unknown
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const double low = static_cast<double>(std::nextafter(least, -infinity)) - resolution;
  const double high = static_cast<double>(std::nextafter(most, infinity)) + resolution;
  if (limit.op == ">") return high > limit.value;
  if (limit.op == ">=") return high >= limit.value;
  if (limit.op == "<") return low < limit.value;
  if (limit.op == "<=") return low <= limit.value;
  return low <= limit.value && limit.value <= high;
}

using Ranges = std::vector<TimeRange>;

void add(Ranges& ranges, TimeRange next) {
  if (!ranges.empty() && next.begin <= ranges.back().end) {
    ranges.back().end = std::max(ranges.back().end, next.end);
  } else {
    ranges.push_back(next);
  }
}

Ranges common(const Ranges& a, const Ranges& b) {
  Ranges out;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const TimeRange both{std::max(a[i].begin, b[j].begin), std::min(a[i].end, b[j].end)};
    if (both.begin <= both.end) out.push_back(both);
    ++(a[i].end < b[j].end ? i : j);
  }
  return out;
}

Ranges joined(Ranges a, const Ranges& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::ranges::sort(a, {}, &TimeRange::begin);
  Ranges out;
  for (const TimeRange& range : a) add(out, range);
  return out;
}

/// Summaries of the groups, read once.
class Summaries {
 public:
  Summaries(const SessionReader& session, const std::function<bool()>& goOn)
      : m_session(session), m_goOn(goOn) {}

  /// Null: the group has none, or not of every row.
  const GroupSummary* of(GroupId group) {
    auto [place, isNew] = m_known.try_emplace(group);
    if (isNew) {
      GroupSummary read = m_session.summary(group, m_goOn);
      if (!read.parts.empty() && read.rows() == m_session.groups()[group].rows) {
        place->second = std::move(read);
      }
    }
    return place->second ? &*place->second : nullptr;
  }

 private:
  const SessionReader& m_session;
  const std::function<bool()>& m_goOn;
  std::map<GroupId, std::optional<GroupSummary>> m_known;
};

/// Where the limit may hold. `isOwn`: the variable is of the group at whose rows the curve is
/// evaluated; else its value counts until the next row, or for 10 s.
Ranges timesOf(const GroupSummary& summary, std::uint32_t column, double resolution,
               const Limit& limit, bool isOwn) {
  Ranges out;
  std::optional<TimeRange> open;  // ends where the next bucket begins
  const auto close = [&](double next) {
    if (!open) return;
    if (isOwn) {
      open->end = std::min(next, open->end + SummaryPart::maxSilence);
    } else {
      open->end = std::min(next, open->end + SummaryPart::maxSilence) + SummaryPart::maxSilence;
    }
    add(out, {open->begin - timeRounding, open->end + timeRounding});
    open.reset();
  };
  for (const SummaryPart& part : summary.parts) {
    const SummaryPart::Column& values = part.columns[column];
    for (std::size_t i = 0; i < part.buckets(); ++i) {
      close(part.begin[i]);
      const auto at = [i](const std::vector<float>& of) { return of[of.size() == 1 ? 0 : i]; };
      if (canHold(limit, at(values.min), at(values.max), resolution)) {
        open = {part.begin[i], part.end[i]};
      }
    }
  }
  close(std::numeric_limits<double>::infinity());
  return out;
}

}  // namespace

std::optional<std::vector<TimeRange>> possibleTimes(const SessionReader& session,
                                                    const SessionQuery& query,
                                                    std::span<const std::string> conditions,
                                                    const std::function<bool()>& goOn) {
  // A recording that was cut off would have to be read for the rest of its summary.
  if (!session.hasSummaries() || !session.complete()) return {};
  std::vector<std::vector<Limit>> limits;
  for (const std::string& condition : conditions) limits.push_back(limitsOf(condition));
  if (std::ranges::any_of(limits, &std::vector<Limit>::empty)) return {};
  Summaries summaries(session, goOn);
  Ranges out;
  for (std::size_t c = 0; c < query.curves().size(); ++c) {
    const auto variables = query.variables(c);
    const GroupId own = variables.front().second.group;
    std::optional<Ranges> ofCurve;
    for (const Limit& limit : limits[query.curves()[c].value]) {
      const auto found = std::ranges::find_if(
          variables, [&](const auto& one) { return one.first == limit.variable; });
      if (found == variables.end()) continue;
      const auto [group, column] = found->second;
      const GroupSummary* summary = summaries.of(group);
      if (summary == nullptr) continue;
      const ColumnInfo& info = session.groups()[group].info.columns[column];
      Ranges times = timesOf(*summary, column, info.resolution, limit, group == own);
      ofCurve = ofCurve ? common(*ofCurve, times) : std::move(times);
    }
    if (!ofCurve) return {};
    out = joined(std::move(out), *ofCurve);
  }
  return out;
}

}  // namespace pitchboard::telemetry
