// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorded_cycles.h"

#include <array>
#include <cstdlib>
#include <utility>

#include <robotlink/blackboard/cycle_words.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view matchCycle = "MATCH_CYCLE";  // the match counts ticks there, not cycles
constexpr double longestSearch = 60.0;                  // s of the recording

bool isUsed(const telemetry::SessionReader& session, const RecordedRobot& recorded, RowSlot slot) {
  bool used = false;
  const std::array only{recorded.group};
  session.rows({recorded.begin, recorded.begin + longestSearch}, only,
               [&](telemetry::GroupId, const telemetry::RowView& row) {
                 used = slot.readInt(row) < 0;
                 return !used;
               });
  return used;
}

}  // namespace

std::optional<RecordedCycles> RecordedCycles::find(const telemetry::SessionReader& session,
                                                   const RecordedRobot& recorded,
                                                   const RerunChoice& choice) {
  std::vector<std::string> names{cycleVariable(choice.process, cycleSuffix)};
  const telemetry::GroupInfo& group = session.groups()[recorded.group].info;
  const RowSlot clock = findSlot(group, {cycleVariable(choice.process, clockSuffix)});
  // One program of a robot cooperates with a match.
  if (!choice.isInside) {
    names.push_back(choice.cycle.empty() ? std::string(matchCycle) : choice.cycle);
  }
  for (const std::string& name : names) {
    const RowSlot slot = findSlot(group, {name});
    if (slot.present() && isUsed(session, recorded, slot)) {
      return RecordedCycles(name, slot, name == names.front() ? clock : RowSlot{});
    }
  }
  return {};
}

bool RecordedCycles::take(const telemetry::RowView& row) {
  const int now = m_slot.readInt(row);
  const int before = std::exchange(m_last, now);
  if (std::exchange(m_isFirst, false) || now == before) return false;
  const bool counts = m_variable != matchCycle && before != 0 && now != 0;
  const int step = std::abs(now) - std::abs(before);
  m_beganAnew = counts && step < 0;
  if (counts && step > 1) m_missed += static_cast<std::uint64_t>(step - 1);
  // One that is over already began after the last row, unless that showed its beginning.
  return now > 0 || (now < 0 && before < 0) || (now < 0 && counts && step != 0);
}

double RecordedCycles::secondsOf(const telemetry::RowView& row) const {
  return m_clock.present() ? m_clock.readInt(row) / 1000.0 : row.time;
}

}  // namespace pitchboard::link
