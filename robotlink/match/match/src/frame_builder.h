// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fills match frames: reads snapshot and blackboards, remembers when a working flag was last seen,
// measures the speed reached. Used on the runner's thread. Private to robotlink.

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <memory>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/match/match_runner.h>

namespace pitchboard::link {

class FrameBuilder {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Adds time spent in ticks.
  void addBusy(std::chrono::steady_clock::duration busy, std::uint64_t ticks);
  /// Standing still or playing at another speed: measure again.
  void resetSpeed(Time now, std::uint64_t tick);
  /// Everything but serial and dropped counts. `still`: processes are not expected to respond.
  void fill(SimulatedMatch& match, Time now, bool still, MatchFrame& out);

 private:
  struct Sample {
    Time time;
    std::uint64_t tick = 0;
    std::uint64_t ticksDone = 0;
    double busy = 0.0;  // s
  };
  void fillRobot(const SimulatedMatch& match, RobotFrame& out);
  std::shared_ptr<const FrameSettings> settingsOf(const sim::WorldState& state);
  void takeProcesses(const RobotSlots& robots);
  void fillSpeed(const SimulatedMatch& match, Time now, bool still, MatchFrame& out);

  std::deque<Sample> m_samples;
  std::uint64_t m_ticksDone = 0;
  double m_busy = 0.0;
  std::map<RobotId, LampMemory> m_lamps;
  std::array<const Variable*, telemetry::fieldMeaningCount> m_variables{};  // of m_catalog
  const VariableCatalog* m_catalog = nullptr;
  Time m_last{};
  double m_playing = 0.0;  // s in which the match did not stand still
  std::shared_ptr<const FrameSettings> m_settings = std::make_shared<const FrameSettings>();
  sim::Snapshot m_snapshot;  // keeps its memory
  std::uint64_t m_processVersion = 0;
  std::map<RobotId, std::shared_ptr<const std::vector<ProcessStatus>>> m_processes;
  std::vector<CognitionDebug>
      m_cognitionDebug;  // change seldom, and cost more than the rest of a frame
  Time m_debugTime{};
};

}  // namespace pitchboard::link
