// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a TeamMonitor keeps of robots and senders. Private to team_monitor.cpp and
// team_monitor_snapshot.cpp, which writes it as text and reads it back: a new member of Robot that
// statuses follow from belongs into both functions there.

#include <telemetry/monitor/team_monitor.h>

namespace pitchboard::telemetry {

/// Robots that may come to those of a monitor: the teams', those without a team, simulated ones.
inline std::size_t maxPlaces(const MonitorOptions& options) {
  return options.maxRobots() + std::size_t{2} * MonitorOptions::ordinaryRobots;
}

struct TeamMonitor::Robot {
  RobotKey key;
  Sender sender;
  struct Other {
    Sender sender;
    WallTime last{};
  };
  std::vector<Other> others;       ///< that said the same
  std::optional<Sender> previous;  ///< the one before, when it sends from another one
  bool moved = false;              ///< its last message was the first one of this sender
  WallTime last{};
  Duration offline{};
  std::uint64_t messages = 0, bytes = 0, recoveries = 0, duplicates = 0;
  ArrivalStats arrivals;
  SequenceStats sequence, previousSequence;
  ErrorTally errors;
  struct Process {
    ProcessFilter filter;
    bool known = false;
    WallTime since{};
  };
  std::array<Process, processCount> processes{};
  std::optional<double> volts;
  double highestVolts = 0.0;
  std::optional<double> charge;  ///< 0 to 1
  std::size_t lastHash = 0;
  WallTime lastHashTime{};
  std::shared_ptr<const TextDecoder> decoder;
  std::vector<double> values;
  std::vector<std::string> texts;
  std::vector<std::string> extras;
};

struct TeamMonitor::SenderRecord {
  SenderStatus status;
};

}  // namespace pitchboard::telemetry
