// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays whole matches with their referee in lock-step, and looks at what must hold in every one:
// only transitions of the controllers' table, nobody stuck, the match ends. For tests and the tool
// whole_matches; one thread.

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

struct WholeMatch {
  int left = 0, right = 0;  ///< goals of the teams of blue and red
  double seconds = 0.0;
  bool over = false;
  int setPlays = 0, dropBalls = 0, penalties = 0, kicks = 0;
  double longestStuck = 0.0;  ///< s
  std::string stuckRobot;
  std::array<int, 20> penaltiesOf{};
  std::vector<std::string> wrong;  ///< transitions that no controller makes
};

inline bool isTransition(sim::PlayState from, sim::PlayState to, sim::GamePhase phase) {
  using S = sim::PlayState;
  static const std::set<std::pair<S, S>> allowed{
      {S::Initial, S::Ready},    {S::Ready, S::Set},       {S::Set, S::Playing},
      {S::Playing, S::Ready},    {S::Ready, S::Finished},  {S::Set, S::Finished},
      {S::Playing, S::Finished}, {S::Finished, S::Initial}};
  if (allowed.count({from, to}) > 0) return true;
  const bool shot = phase == sim::GamePhase::ShootOut &&
                    (from == S::Initial || from == S::Finished) && to == S::Set;
  const bool timeout = phase == sim::GamePhase::Timeout && to == S::Initial;
  return shot || timeout;
}

/// A robot that means to walk or turn and stays on one spot.
class StuckWatch {
 public:
  static constexpr double reach = 0.1;  // m

  void look(const SimulatedMatch& match, WholeMatch& out) {
    const sim::WorldState& world = match.simulation().state();
    const bool playing = world.game->state == sim::PlayState::Playing && world.game->ballFree();
    match.simulation().snapshot(m_now);
    m_robots.resize(world.robots.size());
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      One& one = m_robots[i];
      const sim::RobotSnapshot& robot = m_now.robots[i];
      const int team = world.game->teamOf(robot.identity.team);
      const bool plays = playing && team >= 0 &&
                         world.game->teams[static_cast<std::size_t>(team)]
                                 .players[static_cast<std::size_t>(robot.identity.number - 1)]
                                 .penalty == sim::PenaltyKind::None;
      const bool moved = std::hypot(robot.pose.position.x - one.place.x,
                                    robot.pose.position.y - one.place.y) > reach;
      if (!plays || moved) one = {robot.pose.position, 0, 0};
      ++one.ticks;
      if (robot.action != 0 && robot.action != 11) ++one.walking;
      if (one.walking * 10 < one.ticks * 9) continue;
      const double seconds = one.ticks / world.settings.tickRate;
      if (seconds <= out.longestStuck) continue;
      out.longestStuck = seconds;
      out.stuckRobot = robot.identity.name();
    }
  }

 private:
  struct One {
    Point place;
    int ticks = 0, walking = 0;
  };
  std::vector<One> m_robots;
  sim::Snapshot m_now;
};

inline WholeMatch playWhole(SimulatedMatch& match, double mostSeconds) {
  WholeMatch out;
  StuckWatch stuck;
  sim::PlayState state = match.simulation().state().game->state;
  const double rate = match.simulation().state().settings.tickRate;
  const auto last = static_cast<std::uint64_t>(mostSeconds * rate);
  while (match.finishedBy() != "full_time" && match.simulation().state().tick < last) {
    match.tick();
    const sim::WorldState& world = match.simulation().state();
    for (const sim::Event& event : match.simulation().events()) {
      switch (event.kind) {
        case sim::EventKind::PlayStateChanged: {
          const auto next = static_cast<sim::PlayState>(event.value);
          if (!isTransition(state, next, world.game->phase)) {
            out.wrong.push_back(std::string(wordsOf(state)) + " to " + std::string(wordsOf(next)));
          }
          state = next;
          break;
        }
        case sim::EventKind::SetPlayBegan:
          ++out.setPlays;
          break;
        case sim::EventKind::DropBall:
          ++out.dropBalls;
          break;
        case sim::EventKind::Penalised:
          ++out.penalties;
          ++out.penaltiesOf[static_cast<std::size_t>(event.value)];
          break;
        case sim::EventKind::Kick:
          ++out.kicks;
          break;
        default:
          break;
      }
    }
    if (world.tick % 6 == 0) stuck.look(match, out);
  }
  const sim::WorldState& world = match.simulation().state();
  out.left = world.game->teams[0].score;
  out.right = world.game->teams[1].score;
  out.seconds = static_cast<double>(world.tick) / rate;
  out.over = world.game->over;
  // Looked at every sixth tick.
  out.longestStuck *= 6;
  return out;
}

}  // namespace pitchboard::link
