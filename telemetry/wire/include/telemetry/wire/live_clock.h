// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one clock of everything that is received: it only goes forward, also while the computer
// sleeps, and is printed as the time of day at which it was made plus what has passed since. Who
// sets the computer's clock therefore moves nothing that was heard; by how much it was set is told
// apart. Immutable once made; any thread, as far as its source allows.

#include <functional>

#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// Where the time comes from; tests hand in their own.
struct ClockSource {
  std::function<Duration()> monotonic;  ///< since any moment, never back, on while asleep
  std::function<WallTime()> wall;       ///< the computer's clock, which may be set
  static ClockSource system();
};

class LiveClock {
 public:
  explicit LiveClock(ClockSource source = ClockSource::system());

  WallTime began() const { return m_wall; }
  WallTime now() const { return m_wall + passed(); }
  /// When a datagram arrived that the kernel stamped by the computer's clock. A stamp that this
  /// clock contradicts (it was set in between) counts as now.
  WallTime arrival(WallTime stamp) const;
  /// Seconds since the clock was made.
  double seconds(WallTime time) const { return secondsOf(time - m_wall); }
  /// By how much the computer's clock was set since then; 0 when it was not.
  Duration setBy() const { return m_source.wall() - now(); }

 private:
  Duration passed() const { return m_source.monotonic() - m_monotonic; }

  ClockSource m_source;
  Duration m_monotonic;
  WallTime m_wall;
};

}  // namespace pitchboard::telemetry
