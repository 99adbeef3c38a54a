// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_comparer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitchboard::link {
namespace {

constexpr double minMargin = 0.1;  // s around a stretch in which the unchanged program differs

}  // namespace

OutputComparer::OutputComparer(std::span<const telemetry::ColumnInfo> columns, double slack,
                               std::vector<ComparedVariable> unchanged, bool exact)
    : m_unchanged(std::move(unchanged)), m_tracks(columns.size()), m_slack(slack) {
  for (const telemetry::ColumnInfo& column : columns) {
    ComparedVariable& variable = m_variables.emplace_back();
    variable.column = column;
    variable.tolerance = exact ? 0.0 : toleranceOf(column);
  }
}

void OutputComparer::add(double time, std::span<const ComparedValue> values) {
  for (std::size_t i = 0; i < m_tracks.size(); ++i) {
    Track& track = m_tracks[i];
    track.moments.push_back({time, values[i]});
    judgeTo(i, time);
    const double needed = track.moments[std::min(track.next, track.moments.size() - 1)].time;
    while (!track.moments.empty() && track.next > 0 &&
           track.moments.front().time < needed - m_slack) {
      track.moments.pop_front();
      --track.next;
    }
  }
}

/// Judges all moments whose slack has passed at `time`.
void OutputComparer::judgeTo(std::size_t index, double time) {
  Track& track = m_tracks[index];
  while (track.next < track.moments.size() && track.moments[track.next].time + m_slack <= time) {
    judge(index, track.moments[track.next]);
    ++track.next;
  }
}

void OutputComparer::finish() {
  for (std::size_t i = 0; i < m_tracks.size(); ++i) {
    judgeTo(i, std::numeric_limits<double>::infinity());
    if (!m_tracks[i].moments.empty()) close(i, m_tracks[i].moments.back().time);
  }
}

void OutputComparer::judge(std::size_t index, const Moment& moment) {
  ComparedVariable& variable = m_variables[index];
  const ComparedValue& value = moment.value;
  if (!value.counts) return close(index, moment.time);
  ++variable.compared;
  variable.unequal += !value.isSame;
  const bool alike = value.isSame || isAlike(variable, value.recorded, value.rerun) ||
                     (m_slack > 0.0 && isLate(index, moment));
  if (alike) return close(index, moment.time);
  if (differsUnchanged(variable.column.name, moment.time)) {
    ++variable.unchangedToo;
    return close(index, moment.time);
  }
  const double apart = variable.isCode() ? 0.0 : std::abs(value.recorded - value.rerun);
  Track& track = m_tracks[index];
  if (!track.isOpen) {
    track.isOpen = true;
    ++variable.stretchCount;
    const DifferentStretch begun{moment.time, moment.time, value.recorded, value.rerun, apart};
    if (variable.stretches.size() < ComparedVariable::maxStretches) {
      variable.stretches.push_back(begun);
      m_begun.push_back({index, begun});
    }
  }
  if (variable.stretchCount == variable.stretches.size()) {
    DifferentStretch& open = variable.stretches.back();
    variable.seconds += moment.time - open.end;
    open.end = moment.time;
    open.largest = std::max(open.largest, apart);
  }
  variable.largest = std::max(variable.largest, apart);
}

void OutputComparer::close(std::size_t index, double time) {
  if (!std::exchange(m_tracks[index].isOpen, false)) return;
  ComparedVariable& variable = m_variables[index];
  if (variable.stretchCount != variable.stretches.size()) return;
  variable.seconds += time - variable.stretches.back().end;
  variable.stretches.back().end = time;
}

bool OutputComparer::isAlike(const ComparedVariable& variable, double a, double b) const {
  return a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= variable.tolerance;
}

/// Whether each side had the other's value within the slack: the same codes, or numbers between
/// which it changed.
bool OutputComparer::isLate(std::size_t index, const Moment& moment) const {
  const ComparedVariable& variable = m_variables[index];
  double recordedMin = std::numeric_limits<double>::infinity(), recordedMax = -recordedMin;
  double rerunMin = recordedMin, rerunMax = -recordedMin;
  bool recordedHad = false, rerunHad = false;
  for (const Moment& other : m_tracks[index].moments) {
    if (std::abs(other.time - moment.time) > m_slack || !other.value.counts) continue;
    recordedHad = recordedHad || isAlike(variable, other.value.recorded, moment.value.rerun);
    rerunHad = rerunHad || isAlike(variable, other.value.rerun, moment.value.recorded);
    recordedMin = std::min(recordedMin, other.value.recorded);
    recordedMax = std::max(recordedMax, other.value.recorded);
    rerunMin = std::min(rerunMin, other.value.rerun);
    rerunMax = std::max(rerunMax, other.value.rerun);
  }
  if (variable.isCode()) return recordedHad && rerunHad;
  const auto isBetween = [&](double value, double low, double high) {
    return value >= low - variable.tolerance && value <= high + variable.tolerance;
  };
  return (recordedHad || isBetween(moment.value.rerun, recordedMin, recordedMax)) &&
         (rerunHad || isBetween(moment.value.recorded, rerunMin, rerunMax));
}

bool OutputComparer::differsUnchanged(const std::string& name, double time) const {
  const double margin = std::max(minMargin, m_slack);
  for (const ComparedVariable& one : m_unchanged) {
    if (one.column.name != name) continue;
    // Of so many stretches only the first ones are known.
    if (one.stretchCount > one.stretches.size()) return true;
    return std::ranges::any_of(one.stretches, [&](const DifferentStretch& stretch) {
      return time >= stretch.begin - margin && time <= stretch.end + margin;
    });
  }
  return false;
}

}  // namespace pitchboard::link
