// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides what the agent sends and when: changed values at once, every value at least every two
// seconds, never more than a bandwidth limit. Given values and a clock it makes datagrams; it calls
// nothing of the system. One thread.

#include <chrono>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <telemetry/pb2/pb2.h>

namespace pitchboard::agent {

using Time = std::chrono::microseconds;  ///< of the robot's monotonic clock

struct ScheduleOptions {
  int robot = 1;
  double rate = 20.0;           ///< how often next() is called, Hz
  double bytesPerSecond = 0.0;  ///< of all receivers, with IP and UDP headers; 0: no limit
  int receivers = 1;            ///< how often each datagram is sent
};

class Schedule {
 public:
  /// IP and UDP headers of a datagram.
  static constexpr std::size_t headerBytes = 28;
  /// The smallest limit that lets every variable through.
  static constexpr double leastBytesPerSecond = 2000.0;
  /// Every value is promised each 2 s: a little sooner, because datagrams leave at ticks.
  static constexpr Time refreshPeriod = std::chrono::milliseconds(1900);
  static constexpr Time promisedPeriod = std::chrono::seconds(2);
  /// The refresh alone makes no more datagrams than one in this time.
  static constexpr Time refreshStep = std::chrono::milliseconds(95);
  static constexpr Time statusStep = std::chrono::seconds(1);

  Schedule(const ScheduleOptions& options, std::vector<link::Variable> variables);

  std::span<const link::Variable> variables() const { return m_variables; }

  /// What to send now. `words` are the variables' words, read at `now`, in the order of
  /// variables(); empty while there is no blackboard. Valid until the next call.
  const std::vector<std::string>& next(Time now, std::span<const std::uint32_t> words);

  /// Variables whose change waits for bandwidth.
  std::size_t waiting() const { return m_queue.size(); }
  /// In this time every value is sent once, at present.
  Time refreshTime(Time now) const;

 private:
  static constexpr Time longAgo = std::chrono::hours(-1);

  struct State {
    std::uint32_t sent = 0;
    bool known = false;   // `sent` was sent
    bool queued = false;  // stands in m_queue
    Time sentAt = longAgo;
  };
  struct Spent {
    Time at;
    double bytes;
  };

  void refill(Time now);
  double room() const;
  bool put(std::size_t index, Time now, double room);
  bool open(Time now, double room, std::size_t fieldBytes);
  void close();
  void spend(Time now, double bytes);
  void sendChanges(Time now, std::span<const std::uint32_t> words);
  void sendRefresh(Time now);

  ScheduleOptions m_options;
  std::vector<link::Variable> m_variables;
  std::vector<State> m_states;
  std::vector<std::uint32_t> m_words;  // the newest sample
  std::deque<std::size_t> m_queue;     // changed, who waits longest first
  std::vector<std::string> m_datagrams;
  std::vector<telemetry::Pb2Writer> m_open;  // at most one
  std::uint32_t m_sequence = 0;

  // Bandwidth: what may be spent now, what of it only the refresh may spend, and the last second.
  double m_tokens = 0.0, m_reserve = 0.0;
  std::deque<Spent> m_lastSecond;
  double m_spentLastSecond = 0.0;
  double m_spentNow = 0.0;  // in this call, when there is no limit, too

  // Refresh: the number of values whose refresh is overdue, and the next one.
  double m_due = 0.0;
  std::size_t m_cursor = 0;
  Time m_roundStart{}, m_lastRound{}, m_lastRefresh = longAgo;

  bool m_started = false, m_there = false, m_reportedThere = false;
  Time m_last{}, m_lastStatus = longAgo;
};

}  // namespace pitchboard::agent
