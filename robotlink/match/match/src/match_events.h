// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the events of a simulated match: those of each step, and what has changed since it last
// looked (clock, end of the match, processes). Private to the module; used by SimulatedMatch on its
// thread.

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <robotlink/frame/ball_sight.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/match/followed_recording.h>
#include <robotlink/processes/process_manager.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

class MatchEvents {
 public:
  MatchEvents() { m_events.reserve(16); }  // most ticks allocate nothing
  /// Between steps: makes events of the referee's calls since the last step, so that they are
  /// reported while the match is paused, too.
  void called(sim::Simulation& simulation);
  /// Right after a step.
  void stepped(const sim::Simulation& simulation);
  /// The same, with what robots sensed in it, in their order; `again`: its events were reported
  /// before.
  void sensed(const sim::WorldState& state, std::span<const sim::Percepts> percepts, bool again);
  /// After a jump to another moment, whose robots may see the ball or not.
  void forgetSight() { m_sight.clear(); }
  /// `finishedBy`: as SimulatedMatch::finishedBy().
  void look(const sim::WorldState& state, std::string_view finishedBy);
  /// What the supervisor tells of processes.
  void drainNews(const sim::WorldState& state, const std::vector<ProcessNews>& news);
  /// Robots stopped following a recording.
  void letGo(const FollowState& following);
  /// A team's program, which the match does not wait for any longer.
  void notAttached(const sim::WorldState& state, RobotId robot, const std::string& process,
                   std::string detail);
  /// A robot's program, which the match does not wait for any longer; `why` as a clause.
  void lateCycle(const sim::WorldState& state, RobotId robot, const std::string& why);
  /// Appends what came since the last call, at most the newest 1000.
  void take(std::vector<MatchEvent>& out);

 private:
  static constexpr std::size_t maxKept = 1000;
  enum class Game { Unknown, Playing, ClockStopped, Over };

  void add(MatchEvent event);
  MatchEvent ofProcess(MatchEventKind kind, const sim::WorldState& state, RobotId robot,
                       const std::string& process);

  std::vector<MatchEvent> m_events;
  Game m_game = Game::Unknown;
  std::set<std::pair<RobotId, std::string>> m_everRan;  // robot, process
  std::map<RobotId, std::string> m_names;               // processes may outlive their robot
  std::map<RobotId, BallSight> m_sight;
};

}  // namespace pitchboard::link
