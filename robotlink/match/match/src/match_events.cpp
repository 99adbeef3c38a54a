// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_events.h"

#include <algorithm>
#include <array>
#include <iterator>

#include <robotlink/frame/teams.h>

namespace pitchboard::link {
namespace {

/// Of a process that ran before, in the order of ProcessNewsKind.
constexpr std::array kindOfNews{
    MatchEventKind::ProcessRestarted,     MatchEventKind::ProcessRestarted,
    MatchEventKind::ProcessEnded,         MatchEventKind::ProcessDied,
    MatchEventKind::ProcessNotResponding, MatchEventKind::ProcessGivenUp,
    MatchEventKind::ProcessRealTime};
static_assert(kindOfNews.size() == static_cast<std::size_t>(ProcessNewsKind::RealTime) + 1);

}  // namespace

void MatchEvents::add(MatchEvent event) {
  if (m_events.size() >= maxKept) m_events.erase(m_events.begin());
  m_events.push_back(std::move(event));
}

void MatchEvents::called(sim::Simulation& simulation) {
  for (const sim::Event& event : simulation.drainCalled())
    add(matchEvent(event, simulation.state()));
}

void MatchEvents::stepped(const sim::Simulation& simulation) {
  for (const sim::Event& event : simulation.untakenEvents()) {
    add(matchEvent(event, simulation.state()));
  }
}

void MatchEvents::sensed(const sim::WorldState& state, std::span<const sim::Percepts> percepts,
                         bool again) {
  const double time = static_cast<double>(state.tick) / state.settings.tickRate;
  for (std::size_t i = 0; i < state.robots.size(); ++i) {
    const sim::RobotIdentity& robot = state.robots[i];
    const auto kind = m_sight[robot.id].look(percepts[i].ball.lost == 0, time);
    if (kind && !again) add(eventOf(*kind, time, uidOf(robot.id), robot.name()));
  }
}

void MatchEvents::look(const sim::WorldState& state, std::string_view finishedBy) {
  const Game now = !finishedBy.empty()  ? Game::Over
                   : state.clockRunning ? Game::Playing
                                        : Game::ClockStopped;
  if (std::exchange(m_game, now) == now) return;
  if (state.game && now != Game::Over) return;  // its referee says the state of the game
  MatchEvent event;
  event.kind = now == Game::Over ? MatchEventKind::MatchOver : MatchEventKind::GameState;
  event.time = static_cast<double>(state.tick) / state.settings.tickRate;
  if (now == Game::Playing) event.state = PlayState::Playing;
  event.detail = now == Game::Over      ? std::string(finishedBy)
                 : now == Game::Playing ? "PLAYING"
                                        : "CLOCK STOPPED";
  add(std::move(event));
}

MatchEvent MatchEvents::ofProcess(MatchEventKind kind, const sim::WorldState& state, RobotId id,
                                  const std::string& process) {
  const double time = static_cast<double>(state.tick) / state.settings.tickRate;
  const auto robot = std::find_if(state.robots.begin(), state.robots.end(),
                                  [id](const auto& r) { return r.id == id; });
  if (robot != state.robots.end()) {
    m_names[id] = robot->name();
  }
  MatchEvent event = eventOf(kind, time, uidOf(id), m_names[id]);
  event.process = process;
  return event;
}

void MatchEvents::drainNews(const sim::WorldState& state, const std::vector<ProcessNews>& news) {
  for (const ProcessNews& one : news) {
    const bool starts = one.kind <= ProcessNewsKind::Restarted;
    // The first process of this name since the match began.
    const bool isFirst = starts && m_everRan.emplace(one.robot, one.process).second;
    const auto kind =
        isFirst ? MatchEventKind::ProcessStarted : kindOfNews[static_cast<std::size_t>(one.kind)];
    MatchEvent event = ofProcess(kind, state, one.robot, one.process);
    event.detail = one.detail;
    if (!one.lastOutput.empty()) event.detail += "; last output: " + one.lastOutput;
    if (one.detail.empty()) event.value = static_cast<int>(one.pid);
    add(std::move(event));
  }
}

void MatchEvents::notAttached(const sim::WorldState& state, RobotId robot,
                              const std::string& process, std::string detail) {
  MatchEvent event = ofProcess(MatchEventKind::ProcessNotAttached, state, robot, process);
  event.detail = std::move(detail);
  add(std::move(event));
}

void MatchEvents::lateCycle(const sim::WorldState& state, RobotId robot, const std::string& why) {
  MatchEvent event = ofProcess(MatchEventKind::CycleLate, state, robot, "");
  event.detail = why + "; the match continues without it and is not repeatable";
  add(std::move(event));
}

void MatchEvents::letGo(const FollowState& following) {
  MatchEvent event;
  event.kind = MatchEventKind::LetGo;
  event.time = following.letGoAt.value_or(0.0);
  event.detail = following.why;
  add(std::move(event));
}

void MatchEvents::take(std::vector<MatchEvent>& out) {
  out.insert(out.end(), std::make_move_iterator(m_events.begin()),
             std::make_move_iterator(m_events.end()));
  m_events.clear();
}

}  // namespace pitchboard::link
