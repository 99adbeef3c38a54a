// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorded_world.h"

namespace pitchboard::link {

/// Begins the newest piece whose first tick has been reached. A later piece with the same first
/// tick follows a change by hand, and counts.
bool RecordedWorld::begin(std::uint64_t tick) {
  std::optional<StateSegment> found;
  while (!m_waiting.empty() && m_waiting.front().firstTick() <= tick) {
    found = std::move(m_waiting.front());
    m_waiting.pop_front();
  }
  if (!found) return m_isKnown;
  auto played = found->playedTo(found->lastTick());
  if (!played) return false;
  if (!m_simulation) {
    auto made = sim::Simulation::create(played->from.settings);
    if (!made) return false;
    m_simulation.emplace(std::move(*made));
  }
  // The state is that of the tick that was reached; what was sensed then is still known.
  const bool continues = m_isKnown && m_simulation->state().tick == played->from.tick &&
                         m_simulation->state().robots == played->from.robots;
  if (!m_simulation->restore(played->from)) return false;
  m_hasStepped = m_hasStepped && continues;
  m_commands = std::move(played->commands);
  m_next = 0;
  return true;
}

bool RecordedWorld::goTo(std::uint64_t tick) {
  while (true) {
    m_isKnown = begin(m_isKnown ? std::min(m_simulation->state().tick, tick) : tick);
    if (!m_isKnown) return false;
    const std::uint64_t now = m_simulation->state().tick;
    if (now >= tick) return now == tick;
    if (m_next >= m_commands.size()) {
      // A gap: the next piece begins later.
      if (m_waiting.empty() || m_waiting.front().firstTick() > tick) {
        m_isKnown = false;
        return false;
      }
      m_isKnown = false;
      continue;
    }
    const auto& commands = m_commands[m_next++];
    m_percepts.resize(m_simulation->robotCount());
    if (commands.size() != m_percepts.size()) {
      m_isKnown = false;
      return false;
    }
    m_simulation->step(commands, m_percepts);
    m_hasStepped = true;
  }
}

const sim::Percepts* RecordedWorld::percepts(RobotId robot) const {
  if (!m_isKnown || !m_hasStepped) return nullptr;
  const auto index = m_simulation->indexOf(robot);
  return index && *index < m_percepts.size() ? &m_percepts[*index] : nullptr;
}

}  // namespace pitchboard::link
