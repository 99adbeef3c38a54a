// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides what the agent sends and when: changed values at once, every value at least every two
// seconds, never more than a bandwidth limit. It turns values and times into datagrams and makes no
// system calls. One thread at a time.

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
  double rate = 20.0;  ///< how often next() is called, Hz
  double bytesPerSecond =
      0.0;            ///< for all receivers together, including IP and UDP headers; 0: no limit
  int receivers = 1;  ///< how often each datagram is sent
};

class Schedule {
 public:
  /// IP and UDP headers of a datagram.
  static constexpr std::size_t headerBytes = 28;
  /// The smallest limit with which every variable can still be sent.
  static constexpr double minBytesPerSecond = 2000.0;
  /// Every value is sent at least every promisedPeriod. The schedule aims at a slightly shorter
  /// period, because datagrams are only sent at ticks.
  static constexpr Time refreshPeriod = std::chrono::milliseconds(1900);
  static constexpr Time promisedPeriod = std::chrono::seconds(2);
  /// The refresh alone makes at most one datagram in this time.
  static constexpr Time refreshStep = std::chrono::milliseconds(95);
  static constexpr Time statusStep = std::chrono::seconds(1);

  Schedule(const ScheduleOptions& options, std::vector<link::Variable> variables);

  std::span<const link::Variable> variables() const { return m_variables; }

  /// Returns the datagrams to send now; valid until the next call. `words` are the values of
  /// variables(), read at `now`, in their order; empty while there is no blackboard.
  const std::vector<std::string>& next(Time now, std::span<const std::uint32_t> words);

  /// Returns how many changed variables wait for bandwidth.
  std::size_t waiting() const { return m_queue.size(); }
  /// Returns the time in which every value is currently sent once.
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
  std::deque<std::size_t> m_queue;     // changed variables, those that wait longest first
  std::size_t m_waited = 0;            // of them, those that the step before left
  std::vector<std::string> m_datagrams;
  std::vector<telemetry::Pb2Writer> m_open;  // at most one
  std::uint32_t m_sequence = 0;

  // Bandwidth: the bytes that may be sent now, those of them that are reserved for the refresh, and
  // what was sent in the last second.
  double m_tokens = 0.0, m_reserve = 0.0;
  std::deque<Spent> m_lastSecond;
  double m_spentLastSecond = 0.0;
  double m_spentNow = 0.0;  // in this call, also without a limit

  // Refresh: the number of values whose refresh is overdue, and the next one.
  double m_due = 0.0;
  std::size_t m_cursor = 0;
  Time m_roundStart{}, m_lastRound{}, m_lastRefresh = longAgo;

  bool m_started = false, m_there = false, m_reportedThere = false;
  Time m_last{}, m_lastStatus = longAgo;
};

}  // namespace pitchboard::agent
