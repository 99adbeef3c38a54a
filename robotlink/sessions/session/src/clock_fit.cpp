// SPDX-License-Identifier: GPL-3.0-or-later
// The clock of a robot's own recording, found by the changes that a session of the match has, too.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <robotlink/session/join_recording.h>
#include <robotlink/session/row_slot.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t wantedRows = 20'000;  // of the session; of a longer one, fewer variables
constexpr std::size_t mostOfAKey = 8;       // a value that comes more often tells no time
constexpr double voteWidth = 0.5;           // s
constexpr double pairWithin = 1.0;          // s from the first guess; drift and lost rows are less
constexpr double longestGap = 0.5;          // s between two rows; beyond it a change has no time
constexpr std::size_t slopePoints = 500;
constexpr std::size_t fewestChanges = 20;
constexpr double leastShare = 0.3;
constexpr double normalMad = 1.4826;  // median absolute deviation to standard deviation

/// Where a variable took a value: by a hash of both.
using Changes = std::unordered_map<std::uint64_t, std::vector<double>>;

/// One variable of both groups.
struct CommonColumn {
  std::uint64_t hash = 0;
  RowSlot session, recording;
};

std::vector<CommonColumn> commonColumns(const telemetry::GroupInfo& session,
                                        const telemetry::GroupInfo& recording) {
  std::vector<CommonColumn> common;
  for (const telemetry::ColumnInfo& column : session.columns) {
    const RowSlot there = findSlot(recording, {column.name});
    if (!there.present()) continue;
    common.push_back(
        {std::hash<std::string>()(column.name), findSlot(session, {column.name}), there});
  }
  return common;
}

/// A change happened between two rows; its time is taken to be halfway.
void collectChanges(const telemetry::SessionReader& reader, telemetry::GroupId group,
                    const std::vector<CommonColumn>& columns, RowSlot CommonColumn::*slot,
                    std::uint64_t stride, const Changes* wanted, Changes& out) {
  std::vector<double> last(columns.size(), std::numeric_limits<double>::quiet_NaN());
  double before = 0.0;
  bool isFirst = true;
  const std::array<telemetry::GroupId, 1> only{group};
  reader.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
    const double gap = row.time - before;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double value = (columns[i].*slot).read(row);
      const double old = std::exchange(last[i], value);
      if (isFirst || std::isnan(value) || std::isnan(old) || value == old || gap > longestGap) {
        continue;
      }
      const std::uint64_t key =
          (columns[i].hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15ULL;
      if ((key >> 32) % stride != 0 || (wanted && !wanted->contains(key))) continue;
      auto& times = out[key];
      if (times.size() <= mostOfAKey) times.push_back(row.time - gap / 2.0);
    }
    before = row.time;
    isFirst = false;
    return true;
  });
  std::erase_if(out, [](const auto& one) { return one.second.size() > mostOfAKey; });
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct ChangePair {
  double recorded = 0.0;  // s of the recording
  double apart = 0.0;     // s, session minus recording
};

/// The difference of the clocks to half a second: the one for which most changes agree.
std::optional<double> firstGuess(const Changes& session, const Changes& recording) {
  std::unordered_map<std::int64_t, double> votes;
  for (const auto& [key, times] : session) {
    const auto found = recording.find(key);
    if (found == recording.end()) continue;
    const double weight = 1.0 / static_cast<double>(times.size() * found->second.size());
    for (const double a : times) {
      for (const double b : found->second) {
        votes[static_cast<std::int64_t>(std::floor((a - b) / voteWidth))] += weight;
      }
    }
  }
  std::optional<double> best;
  double most = 0.0;
  for (const auto& [bin, weight] : votes) {
    const auto next = votes.find(bin + 1);
    const double both = weight + (next == votes.end() ? 0.0 : next->second);
    const double middle = static_cast<double>(bin + 1) * voteWidth;
    if (both > most || (both == most && best && middle < *best)) {
      most = both;
      best = middle;
    }
  }
  return best;
}

/// The slope of Theil and Sen, of points spread over all of them.
double medianSlope(const std::vector<ChangePair>& pairs) {
  std::vector<double> slopes;
  const std::size_t step = 1 + pairs.size() / slopePoints;
  const double span = pairs.back().recorded - pairs.front().recorded;
  for (std::size_t i = 0; i < pairs.size(); i += step) {
    for (std::size_t j = i + step; j < pairs.size(); j += step) {
      const double way = pairs[j].recorded - pairs[i].recorded;
      if (way > span / 4.0) slopes.push_back((pairs[j].apart - pairs[i].apart) / way);
    }
  }
  return slopes.empty() ? 0.0 : medianOf(std::move(slopes));
}

/// The line through those pairs that are near the last line, until it stays.
ClockFit fitLine(std::vector<ChangePair> pairs) {
  std::ranges::sort(pairs, {}, &ChangePair::recorded);
  ClockFit fit;
  fit.drift = medianSlope(pairs);
  const auto residuals = [&](bool absolute) {
    std::vector<double> out;
    for (const ChangePair& pair : pairs) {
      const double one = pair.apart - fit.drift * pair.recorded - fit.offset;
      out.push_back(absolute ? std::abs(one) : one);
    }
    return out;
  };
  fit.offset = medianOf(residuals(false));
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const double limit = 3.0 * normalMad * std::max(medianOf(residuals(true)), 1e-4);
    double n = 0.0, sumX = 0.0, sumY = 0.0, sumXX = 0.0, sumXY = 0.0;
    const double origin = pairs[pairs.size() / 2].recorded;  // keeps digits
    for (const ChangePair& pair : pairs) {
      if (std::abs(pair.apart - fit.drift * pair.recorded - fit.offset) > limit) continue;
      const double x = pair.recorded - origin;
      n += 1.0;
      sumX += x;
      sumY += pair.apart;
      sumXX += x * x;
      sumXY += x * pair.apart;
    }
    fit.changes = static_cast<std::size_t>(n);
    const double below = n * sumXX - sumX * sumX;
    if (below <= 0.0) break;
    fit.drift = (n * sumXY - sumX * sumY) / below;
    fit.offset = (sumY - fit.drift * sumX) / n - fit.drift * origin;
  }
  fit.residual = medianOf(residuals(true));
  return fit;
}

}  // namespace

Result<ClockFit> fitClocks(const telemetry::SessionReader& session, telemetry::GroupId robot,
                           const telemetry::SessionReader& recording, telemetry::GroupId recorded) {
  const telemetry::SessionGroup& here = session.groups()[robot];
  const telemetry::GroupInfo& there = recording.groups()[recorded].info;
  const auto columns = commonColumns(here.info, there);
  const std::uint64_t stride = 1 + here.rows / wantedRows;
  Changes received, own;
  collectChanges(session, robot, columns, &CommonColumn::session, stride, nullptr, received);
  collectChanges(recording, recorded, columns, &CommonColumn::recording, stride, &received, own);
  const auto guess = firstGuess(received, own);
  std::vector<ChangePair> pairs;
  std::vector<double> ownTimes;
  for (const auto& [key, times] : own) {
    ownTimes.insert(ownTimes.end(), times.begin(), times.end());
    for (const double a : received.at(key)) {
      for (const double b : times) {
        if (guess && std::abs(a - b - *guess) <= pairWithin) pairs.push_back({b, a - b});
      }
    }
  }
  const auto refuse = [&](const std::string& what) {
    return failure(ErrorCode::NotFound,
                   what +
                       " These are recordings of different robots or of different matches; name "
                       "the robot with --robot, or give the offset with --offset.");
  };
  if (pairs.size() < fewestChanges) {
    return refuse("Only " + std::to_string(pairs.size()) + " changes of " + here.info.name +
                  " are in both recordings.");
  }
  ClockFit fit = fitLine(std::move(pairs));
  const auto range = std::ranges::minmax(ownTimes);
  std::size_t inTime = 0;
  for (const auto& [key, times] : received) {
    inTime += static_cast<std::size_t>(std::ranges::count_if(times, [&](double time) {
      return time >= fit.toSession(range.min) && time <= fit.toSession(range.max);
    }));
  }
  fit.share = inTime == 0
                  ? 0.0
                  : std::min(1.0, static_cast<double>(fit.changes) / static_cast<double>(inTime));
  if (fit.changes < fewestChanges || fit.share < leastShare) {
    return refuse("Only " + std::to_string(static_cast<int>(100.0 * fit.share)) +
                  " % of the changes of " + here.info.name + " fit.");
  }
  return fit;
}

}  // namespace pitchboard::link
