// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Recordings of one match by different programs, each with a clock of its own: the referee's log,
// and tables of a robot that was told the state of the game.

#include <fstream>
#include <string>
#include <vector>

namespace match_recordings {

/// When a state of the game begins; s of the recording's clock.
struct StateChange {
  double time = 0.0;
  int state = 0;  ///< 0 initial, 1 ready, 2 set, 3 playing, 4 finished
  int goals = 0;  ///< of the home team
};

/// A log whose second 0 is 2026-07-01, 10:00 UTC. Whole milliseconds.
inline void writeRefereeLog(const std::string& path, const std::vector<StateChange>& changes) {
  constexpr const char* names[] = {"initial", "ready", "set", "playing", "finished"};
  std::ofstream out(path);
  out << "- timestamp: {secs: 0, nanos: 0}\n  entry: !metadata\n    creator: GameController\n"
         "    version: 6\n    timestamp: 2026-07-01T10:00:00Z\n    params: {competition: "
         "{division: "
         "small, playersPerTeam: 4, halfDuration: {secs: 600, nanos: 0}}, game: {teams: {home: "
         "{number: 12, fieldPlayerColor: blue, goalkeeperColor: black}, away: {number: 7, "
         "fieldPlayerColor: red, goalkeeperColor: black}}}}\n";
  for (const StateChange& change : changes) {
    const auto milliseconds = static_cast<long long>(change.time * 1000.0 + 0.5);
    out << "- timestamp: {secs: " << milliseconds / 1000
        << ", nanos: " << milliseconds % 1000 * 1000000
        << "}\n  entry: !gameState\n    sides: homeDefendsLeftGoal\n    stopped: false\n"
           "    phase: firstHalf\n    state: "
        << names[change.state]
        << "\n    setPlay: noSetPlay\n    kickingSide: home\n    primaryTimer: !started\n"
           "      remaining: [600, 0]\n      runCondition: playing\n      behaviorAtZero: "
           "overflow\n"
           "    secondaryTimer: stopped\n    teams:\n      home: {goalkeeper: 1, score: "
        << change.goals
        << ", messageBudget: 9, players: [{penalty: noPenalty, penaltyTimer: stopped}]}\n"
           "      away: {goalkeeper: 1, score: 0, messageBudget: 9, players: [{penalty: noPenalty, "
           "penaltyTimer: stopped}]}\n";
  }
  out << "- timestamp: {secs: 900, nanos: 0}\n  entry: end\n";
}

/// A table with a row ten times a second from `begin` to `end` (s of its clock), for a mapping
/// whose referee is the topic of the file's name with the columns "state" and "goals".
inline void writeRobotTable(const std::string& path, double begin, double end,
                            const std::vector<StateChange>& changes) {
  std::ofstream out(path);
  out.precision(15);
  out << "time,state,goals,x\n";
  for (int i = 0; begin + 0.1 * i <= end; ++i) {
    const double time = begin + 0.1 * i;
    StateChange now;
    for (const StateChange& change : changes) {
      if (change.time <= time + 1e-6) now = change;
    }
    out << time << ',' << now.state << ',' << now.goals << ',' << 0.01 * i << '\n';
  }
}

}  // namespace match_recordings
