// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fills match frames: reads snapshot and blackboards, remembers when a working flag was last seen,
// measures the speed reached. Used on the runner's thread. Private to robotlink.

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <memory>

#include <robotlink/match/match_runner.h>

namespace pitchboard::link {

class FrameBuilder {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Adds time spent in ticks.
  void addBusy(std::chrono::steady_clock::duration busy, std::uint64_t ticks);
  /// Standing still or playing at another speed: measure anew.
  void resetSpeed(Time now, std::uint64_t tick);
  /// Everything but serial and dropped counts. `still`: flags of simulated processes do not age.
  void fill(SimulatedMatch& match, Time now, bool still, MatchFrame& out);

 private:
  struct Sample {
    Time time;
    std::uint64_t tick = 0;
    std::uint64_t ticksDone = 0;
    double busy = 0.0;  // s
  };
  static constexpr std::size_t flags = 5;
  using LastSeen = std::array<Time, flags>;

  void fillBoard(const SimulatedMatch& match, const sim::RobotIdentity& robot, Time now, bool still,
                 RobotBoardView& out);
  void takeProcesses(const ProcessManager& processes);
  void fillSpeed(const SimulatedMatch& match, Time now, bool still, MatchFrame& out);

  std::deque<Sample> m_samples;
  std::uint64_t m_ticksDone = 0;
  double m_busy = 0.0;
  std::map<RobotId, LastSeen> m_lastSeen;
  sim::Snapshot m_snapshot;  // keeps its memory
  std::uint64_t m_processVersion = 0;
  std::map<RobotId, std::shared_ptr<const std::vector<ProcessStatus>>> m_processes;
  std::vector<RobotThoughts> m_thoughts;  // change seldom, and cost more than the rest of a frame
  Time m_thoughtsTime{};
};

}  // namespace pitchboard::link
