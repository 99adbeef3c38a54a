// SPDX-License-Identifier: GPL-3.0-or-later
#include "timed_writes.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::link {
namespace {

constexpr double tickTolerance = 1e-6;

}  // namespace

std::uint64_t firstTickAtOrAfter(double seconds, double tickRate) {
  return static_cast<std::uint64_t>(std::max(0.0, std::ceil(seconds * tickRate - tickTolerance)));
}

std::uint64_t nextDueTick(double period, std::uint64_t after, double tickRate) {
  const double ticksPerCycle = period * tickRate;
  if (!(ticksPerCycle > 1.0)) return after + 1;
  const double cycle = std::floor((static_cast<double>(after) + tickTolerance) / ticksPerCycle) + 1;
  return std::max(after + 1, firstTickAtOrAfter(cycle * period, tickRate));
}

Result<TimedWrites> TimedWrites::create(const Scenario& scenario, const VariableCatalog& catalog) {
  TimedWrites all;
  for (const BlackboardWrite& write : scenario.writes) {
    const Variable* variable = catalog.find(write.variable);
    if (!variable) {
      return failure(ErrorCode::NotFound, "the scenario writes \"" + write.variable +
                                              "\", which is not in this variable catalog");
    }
    Write& one = all.m_writes.emplace_back();
    one.tick = firstTickAtOrAfter(write.time, scenario.settings.tickRate);
    one.robot = write.robot;
    if (variable->type == VariableType::Int) {
      one.variable = IntVar{variable->index};
    } else {
      one.variable = FloatVar{variable->index};
    }
    one.value = write.value;
  }
  std::ranges::stable_sort(all.m_writes, {}, &Write::tick);
  return all;
}

void TimedWrites::applyDue(std::uint64_t tick, const RobotSlots& slots) {
  for (; m_next < m_writes.size() && m_writes[m_next].tick <= tick; ++m_next) {
    const Write& write = m_writes[m_next];
    for (const auto& slot : slots.all()) {
      if (write.robot.value == 0 || write.robot == slot->id) write.applyTo(slot->board);
    }
  }
}

void TimedWrites::catchUp(Blackboard& board) const {
  for (std::size_t i = 0; i < m_next; ++i) {
    if (m_writes[i].robot.value == 0) m_writes[i].applyTo(board);
  }
}

void TimedWrites::jumpTo(std::uint64_t tick) {
  const auto next = std::ranges::lower_bound(m_writes, tick, {}, &Write::tick);
  m_next = static_cast<std::size_t>(next - m_writes.begin());
}

void TimedWrites::Write::applyTo(Blackboard& board) const {
  if (const auto* whole = std::get_if<IntVar>(&variable)) {
    board.write(*whole, static_cast<int>(value));
  } else {
    board.write(std::get<FloatVar>(variable), static_cast<float>(value));
  }
}

}  // namespace pitchboard::link
