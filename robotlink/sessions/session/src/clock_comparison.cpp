// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/clock_comparison.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include <base/try.h>
#include <robotlink/session/row_slot.h>

namespace pitchboard::link {
namespace {

constexpr double wantedValues = 2e6;        // of the session; of a longer one, fewer changes
constexpr std::size_t mostOfAKey = 8;       // a value that comes more often tells no time
constexpr double voteWidth = 0.5;           // s
constexpr double pairWithin = 1.0;          // s from the first guess; drift and lost rows are less
constexpr double usualGap = 0.5;            // s between two rows; beyond it a change has no time,
constexpr double gapsOfRows = 2.5;          // unless rows come more rarely
constexpr std::size_t measuredRows = 2000;  // at the beginning
constexpr std::size_t slopePoints = 500;
constexpr std::size_t fewestChanges = 20;
constexpr double leastShare = 0.3;
constexpr double normalMad = 1.4826;  // median absolute deviation to standard deviation
constexpr int rowsBetweenLooks = 1000;

/// One variable of both groups. Messages have rounded values, in which both are then compared.
struct CommonColumn {
  static constexpr int exact = -1, significant = -2;  // or decimals
  static constexpr int maxDecimals = 4;
  std::uint64_t hash = 0;
  RowSlot session, recording;
  int rounding = exact;

  double rounded(double value) const {
    if (rounding == exact || !std::isfinite(value)) return value;
    constexpr int digits = 5;
    const double places = rounding != significant ? static_cast<double>(rounding)
                          : value == 0.0          ? 0.0
                                         : digits - 1.0 - std::floor(std::log10(std::abs(value)));
    const double scale = std::pow(10.0, places);
    return std::round(value * scale) / scale + 0.0;  // no minus zero
  }
};

bool isWhole(double value) {
  return std::abs(value - std::round(value)) <= 1e-6 * std::max(1.0, std::abs(value));
}

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

/// Returns 0 if there are no values.
double quantileOf(std::vector<double> values, double quantile) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size()));
  const auto place = values.begin() + std::min(at, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}
double medianOf(std::vector<double> values) {
  return quantileOf(std::move(values), 0.5);
}

/// Finds out how values were rounded, and the time between two rows.
double measure(const telemetry::SessionReader& session, telemetry::GroupId group,
               std::vector<CommonColumn>& columns) {
  std::vector<double> gaps;
  std::vector<int> decimals(columns.size(), 0);
  double before = std::numeric_limits<double>::quiet_NaN();
  const std::array<telemetry::GroupId, 1> only{group};
  session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
    if (row.time > before) gaps.push_back(row.time - before);
    before = row.time;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double value = columns[i].session.read(row);
      int& places = decimals[i];
      while (std::isfinite(value) && places <= CommonColumn::maxDecimals &&
             !isWhole(value * std::pow(10.0, places))) {
        ++places;
      }
    }
    return gaps.size() < measuredRows;
  });
  for (std::size_t i = 0; i < columns.size(); ++i) {
    CommonColumn& column = columns[i];
    if (column.session.type != telemetry::ColumnType::Float64) continue;
    const bool isInt = column.recording.type == telemetry::ColumnType::Int32;
    column.rounding = isInt                                      ? 0
                      : decimals[i] <= CommonColumn::maxDecimals ? decimals[i]
                                                                 : CommonColumn::significant;
  }
  return std::max(usualGap, gapsOfRows * medianOf(std::move(gaps)));
}

/// Takes rows in order of time, and keeps when which variable took which value.
class ChangeCollector {
 public:
  ChangeCollector(const std::vector<CommonColumn>& columns, RowSlot CommonColumn::*slot,
                  std::uint64_t stride, double longestGap, const ValueChanges* wanted,
                  ValueChanges& out)
      : m_columns(columns),
        m_slot(slot),
        m_stride(stride),
        m_longestGap(longestGap),
        m_wanted(wanted),
        m_out(out),
        m_last(columns.size(), {std::numeric_limits<double>::quiet_NaN(), {}}) {}

  void take(const telemetry::RowView& row) {
    const double gap = row.time - m_before;
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
      const CommonColumn& column = m_columns[i];
      const double value = column.rounded((column.*m_slot).read(row));
      Last& last = m_last[i];
      if (value == last.value) continue;
      if (last.key) endOf(*last.key, row.time);
      last.key.reset();
      const double old = std::exchange(last.value, value);
      if (m_isFirst || std::isnan(value) || std::isnan(old) || gap > m_longestGap) continue;
      const std::uint64_t key =
          (column.hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15ULL;
      if ((key >> 32) % m_stride != 0 || (m_wanted && !m_wanted->contains(key))) continue;
      auto& times = m_out[key];
      if (times.size() > mostOfAKey) continue;
      // Of the recording, a change lies between two of its rows.
      times.push_back(m_wanted ? ValueChange{row.time - gap / 2.0, 1e9}
                               : ValueChange{row.time, gap});
      if (m_wanted) last.key = key;
    }
    m_before = row.time;
    m_isFirst = false;
  }
  /// Drops values that came too often, from `also`, too.
  void finish(ValueChanges* also = nullptr) {
    for (const auto& [key, times] : m_out) {
      if (also != nullptr && times.size() > mostOfAKey) also->erase(key);
    }
    std::erase_if(m_out, [](const auto& one) { return one.second.size() > mostOfAKey; });
  }

 private:
  struct Last {
    double value;
    std::optional<std::uint64_t> key;  // of the change to it, if that is kept
  };
  void endOf(std::uint64_t key, double time) {
    ValueChange& change = m_out[key].back();
    change.width = time - change.time;
  }

  const std::vector<CommonColumn>& m_columns;
  RowSlot CommonColumn::*m_slot;
  std::uint64_t m_stride;
  double m_longestGap;
  const ValueChanges* m_wanted;
  ValueChanges& m_out;
  std::vector<Last> m_last;
  double m_before = 0.0;
  bool m_isFirst = true;
};

}  // namespace

Result<ClockComparison> ClockComparison::read(const telemetry::SessionReader& session,
                                              telemetry::GroupId robot,
                                              const RobotRecording& recording,
                                              const std::function<bool()>& goesOn) {
  ClockComparison made;
  const telemetry::SessionGroup& here = session.groups()[robot];
  made.m_robot = here.info.name;
  std::vector<CommonColumn> columns = commonColumns(here.info, recording.group());
  const double gap = measure(session, robot, columns);
  const auto values = static_cast<double>(here.rows) * static_cast<double>(columns.size());
  const auto stride = 1 + static_cast<std::uint64_t>(values / wantedValues);
  int rows = 0;
  bool goes = true;
  const auto look = [&] { return ++rows % rowsBetweenLooks != 0 || !goesOn || (goes = goesOn()); };
  ChangeCollector received(columns, &CommonColumn::session, stride, gap, nullptr, made.m_session);
  const std::array<telemetry::GroupId, 1> only{robot};
  session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
    received.take(row);
    return look();
  });
  received.finish();
  ChangeCollector own(columns, &CommonColumn::recording, stride, usualGap, &made.m_session,
                      made.m_recording);
  bool isFirst = true;
  recording.rows({-1e18, 1e18}, [&](const telemetry::RowView& row) {
    if (std::exchange(isFirst, false)) made.m_recorded.begin = row.time;
    made.m_recorded.end = row.time;
    own.take(row);
    return goes && look();
  });
  own.finish(&made.m_session);
  if (!goes) return failure(ErrorCode::Conflict, "Cancelled.");
  return made;
}

/// A value that came and went between two rows of the session was there just before the later one;
/// one that stayed may have come at any time between them.
double ClockComparison::apart(const ValueChange& session, const ValueChange& recording) {
  return session.time - std::min(session.width, recording.width) / 2.0 - recording.time;
}

namespace {

struct ChangePair {
  double recorded = 0.0;  // s of the recording
  double apart = 0.0;     // s, session minus recording
};

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
  return medianOf(std::move(slopes));
}

/// The line through those pairs that are near the last line, until it stays.
ClockFit fitLine(std::vector<ChangePair> pairs) {
  std::ranges::sort(pairs, {}, &ChangePair::recorded);
  ClockFit fit;
  RobotClock& clock = fit.clock;
  clock.drift = medianSlope(pairs);
  const auto residualOf = [&clock](const ChangePair& pair) {
    return pair.apart - clock.drift * pair.recorded - clock.offset;
  };
  const auto residuals = [&](bool absolute) {
    std::vector<double> out;
    for (const ChangePair& pair : pairs) {
      out.push_back(absolute ? std::abs(residualOf(pair)) : residualOf(pair));
    }
    return out;
  };
  clock.offset = medianOf(residuals(false));
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const double limit = 3.0 * normalMad * std::max(medianOf(residuals(true)), 1e-4);
    double n = 0.0, sumX = 0.0, sumY = 0.0, sumXX = 0.0, sumXY = 0.0, squares = 0.0;
    const double origin = pairs[pairs.size() / 2].recorded;  // keeps digits
    for (const ChangePair& pair : pairs) {
      const double residual = residualOf(pair);
      if (std::abs(residual) > limit) continue;
      const double x = pair.recorded - origin;
      n += 1.0;
      sumX += x;
      sumY += pair.apart;
      sumXX += x * x;
      sumXY += x * pair.apart;
      squares += residual * residual;
    }
    const double below = n * sumXX - sumX * sumX;
    if (below <= 0.0) break;
    clock.drift = (n * sumXY - sumX * sumY) / below;
    clock.offset = (sumY - clock.drift * sumX) / n - clock.drift * origin;
    const double deviation = std::sqrt(squares / n);
    fit.offsetError = deviation / std::sqrt(n);
    fit.driftError = deviation / std::sqrt(below / n);
  }
  return fit;
}

}  // namespace

/// The difference of the clocks to half a second: the one for which most changes agree.
std::optional<double> ClockComparison::firstGuess() const {
  std::unordered_map<std::int64_t, double> votes;
  for (const auto& [key, times] : m_session) {
    const auto found = m_recording.find(key);
    if (found == m_recording.end()) continue;
    const double weight = 1.0 / static_cast<double>(times.size() * found->second.size());
    for (const ValueChange& a : times) {
      for (const ValueChange& b : found->second) {
        votes[static_cast<std::int64_t>(std::floor(apart(a, b) / voteWidth))] += weight;
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

Result<ClockFit> ClockComparison::fit() const {
  const auto guess = firstGuess();
  std::vector<ChangePair> pairs;
  for (const auto& [key, times] : m_recording) {
    for (const ValueChange& a : m_session.at(key)) {
      for (const ValueChange& b : times) {
        const double between = apart(a, b);
        if (guess && std::abs(between - *guess) <= pairWithin) pairs.push_back({b.time, between});
      }
    }
  }
  const auto refuse = [](const std::string& what) {
    return failure(ErrorCode::NotFound,
                   what +
                       " These are recordings of different robots or of different matches; choose "
                       "another robot, or set the offset by hand.");
  };
  if (pairs.size() < fewestChanges) {
    return refuse("Only " + std::to_string(pairs.size()) + " changes of " + m_robot +
                  " are in both recordings.");
  }
  ClockFit fit = fitLine(std::move(pairs));
  const ClockAgreement agreed = agreement(fit.clock);
  if (agreed.agree < fewestChanges || agreed.share() < leastShare) {
    return refuse("Only " + std::to_string(static_cast<int>(100.0 * agreed.share())) +
                  " % of the changes of " + m_robot + " agree.");
  }
  return fit;
}

ClockAgreement ClockComparison::agreement(const RobotClock& clock) const {
  ClockAgreement found;
  const double begin = clock.toSession(m_recorded.begin), end = clock.toSession(m_recorded.end);
  std::vector<double> distances;
  for (const auto& [key, times] : m_session) {
    const auto own = m_recording.find(key);
    for (const ValueChange& change : times) {
      if (change.time < begin || change.time > end) continue;
      ++found.changes;
      if (own == m_recording.end()) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const ValueChange& recorded : own->second) {
        ValueChange here = recorded;
        here.time = clock.toSession(recorded.time);
        const double one = apart(change, here);
        if (std::abs(one) < std::abs(nearest)) nearest = one;
      }
      if (std::abs(nearest) > ClockAgreement::window) continue;
      distances.push_back(std::abs(nearest));
      found.points.push_back({change.time, nearest});
    }
  }
  found.agree = distances.size();
  found.residual = medianOf(distances);
  constexpr double most = 0.9;
  found.spread = quantileOf(std::move(distances), most);
  std::ranges::sort(found.points, {}, &ClockAgreement::Point::time);
  const std::size_t step = 1 + found.points.size() / ClockAgreement::maxPoints;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.points.size(); i += step) {
    found.points[kept++] = found.points[i];
  }
  found.points.resize(kept);
  return found;
}

double ClockAgreement::share() const {
  return changes == 0 ? 0.0 : static_cast<double>(agree) / static_cast<double>(changes);
}

std::string ClockAgreement::text() const {
  if (changes == 0) return "no changes to compare";
  char text[120];
  std::snprintf(text, sizeof text, "%zu of %zu changes agree (%.0f %%), residual %.1f ms", agree,
                changes, 100.0 * share(), 1e3 * residual);
  return text;
}

}  // namespace pitchboard::link
