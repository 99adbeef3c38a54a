// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps simulated time just ahead of the wall clock at a chosen speed, as MuJoCo's simulate does.
// If the computer is too slow, the backlog is dropped, so that the match does not try to catch up.
// A plain value, not thread-safe; the caller passes the time.

#include <chrono>
#include <cstdint>

namespace pitchboard::link {

class Pacer {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds maxBacklog{100};
  static constexpr std::chrono::milliseconds shortestSleep{1};

  /// Starts at this tick and time, with `ticksPerSecond` per second of wall clock.
  void start(Time now, std::uint64_t tick, double ticksPerSecond) {
    m_start = now;
    m_startTick = tick;
    m_ticksPerSecond = ticksPerSecond;
  }

  /// Returns the tick that the simulation should have reached.
  std::uint64_t target(Time now) const {
    const double elapsed = std::chrono::duration<double>(now - m_start).count();
    return m_startTick + static_cast<std::uint64_t>(elapsed * m_ticksPerSecond);
  }

  /// Drops the backlog if it is longer than maxBacklog. Call it at the end of each round with the
  /// tick that was reached.
  void forgive(Time now, std::uint64_t tick) {
    const std::uint64_t wanted = target(now);
    const double behind = wanted > tick ? static_cast<double>(wanted - tick) / m_ticksPerSecond : 0;
    if (behind > std::chrono::duration<double>(maxBacklog).count()) {
      start(now, tick, m_ticksPerSecond);
    }
  }

  /// Returns when to ask again: at the next tick, but not at once.
  Time wake(Time now, std::uint64_t tick) const {
    const double seconds = static_cast<double>(tick + 1 - m_startTick) / m_ticksPerSecond;
    const Time due = m_start + std::chrono::ceil<std::chrono::steady_clock::duration>(
                                   std::chrono::duration<double>(seconds));
    return due > now + shortestSleep ? due : now + shortestSleep;
  }

 private:
  Time m_start;
  std::uint64_t m_startTick = 0;
  double m_ticksPerSecond = 60.0;
};

}  // namespace pitchboard::link
