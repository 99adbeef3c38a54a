// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_events.h"

#include <algorithm>
#include <iterator>

namespace pitchboard::link {

void MatchEvents::add(MatchEvent event) {
  if (m_events.size() >= mostKept) m_events.erase(m_events.begin());
  m_events.push_back(std::move(event));
}

void MatchEvents::stepped(const sim::Simulation& simulation) {
  for (const sim::Event& event : simulation.events()) add(matchEvent(event, simulation.state()));
}

void MatchEvents::look(const sim::WorldState& state, std::string_view finishedBy,
                       const ProcessSupervisor& supervisor) {
  const double time = static_cast<double>(state.tick) / state.settings.tickRate;
  lookAtGame(state, time, finishedBy);
  lookAtProcesses(state, time, supervisor);
}

void MatchEvents::lookAtGame(const sim::WorldState& state, double time,
                             std::string_view finishedBy) {
  const Game now = !finishedBy.empty()  ? Game::Over
                   : state.clockRunning ? Game::Playing
                                        : Game::ClockStopped;
  if (std::exchange(m_game, now) == now) return;
  if (state.game && now != Game::Over) return;  // its referee says the state of the game
  MatchEvent event;
  event.kind = now == Game::Over ? MatchEventKind::MatchOver : MatchEventKind::GameState;
  event.time = time;
  event.detail = now == Game::Over      ? std::string(finishedBy)
                 : now == Game::Playing ? "PLAYING"
                                        : "CLOCK STOPPED";
  add(std::move(event));
}

MatchEvent MatchEvents::ofProcess(MatchEventKind kind, const sim::WorldState& state, double time,
                                  const ChildStatus& child) {
  const RobotId id = child.spec.robot;
  const auto robot = std::find_if(state.robots.begin(), state.robots.end(),
                                  [id](const auto& r) { return r.id == id; });
  MatchEvent event;
  if (robot != state.robots.end()) {
    event = eventOf(kind, time, *robot);
    m_names[id] = event.name;
  } else {
    event.kind = kind;
    event.time = time;
    event.robot = id;
    event.name = m_names[id];
  }
  event.process = child.spec.name;
  return event;
}

void MatchEvents::lookAtProcesses(const sim::WorldState& state, double time,
                                  const ProcessSupervisor& supervisor) {
  const auto& children = supervisor.children();
  for (std::size_t i = 0; i < children.size(); ++i) {
    const ChildStatus& child = children[i];
    if (i >= m_children.size()) {
      m_children.push_back(ChildState::Running);
      const bool isFirst = m_everRan.emplace(child.spec.robot, child.spec.name).second;
      MatchEvent event =
          ofProcess(isFirst ? MatchEventKind::ProcessStarted : MatchEventKind::ProcessRestarted,
                    state, time, child);
      event.value = static_cast<int>(child.pid);
      add(std::move(event));
    }
    if (std::exchange(m_children[i], child.state) == child.state) continue;
    const bool died = child.state == ChildState::Failed;
    MatchEvent event = ofProcess(died ? MatchEventKind::ProcessDied : MatchEventKind::ProcessEnded,
                                 state, time, child);
    event.detail = child.asked ? "it was asked to" : child.detail;
    if (died && !child.lastOutput.empty()) event.detail += "; its last words: " + child.lastOutput;
    add(std::move(event));
  }
}

void MatchEvents::take(std::vector<MatchEvent>& out) {
  out.insert(out.end(), std::make_move_iterator(m_events.begin()),
             std::make_move_iterator(m_events.end()));
  m_events.clear();
}

}  // namespace pitchboard::link
