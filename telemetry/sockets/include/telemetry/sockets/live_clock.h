// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of everything that is received. It only goes forward, also while the computer sleeps:
// it is the time of day at which it was made, plus what has passed since. So setting the computer's
// clock does not shift timestamps; setBy() tells by how much it was set. Immutable; any thread, if
// its source allows that.

#include <functional>

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// Where the time comes from. Tests use a source of their own.
struct ClockSource {
  std::function<Duration()> monotonic;  ///< since any moment; never goes back, counts while asleep
  std::function<WallTime()> wall;       ///< the computer's clock, which may be set
  static ClockSource system();
};

class LiveClock {
 public:
  explicit LiveClock(ClockSource source = ClockSource::system());

  WallTime began() const { return m_wall; }
  WallTime now() const { return m_wall + passed(); }
  /// Converts the kernel's timestamp of a datagram, which is by the computer's clock. If that was
  /// set in between, the datagram counts as having arrived now.
  WallTime arrival(WallTime stamp) const;
  /// Returns seconds since the clock was made.
  double seconds(WallTime time) const { return secondsOf(time - m_wall); }
  /// Returns by how much the computer's clock was set since then; 0 if it was not.
  Duration setBy() const { return m_source.wall() - now(); }

 private:
  Duration passed() const { return m_source.monotonic() - m_monotonic; }

  ClockSource m_source;
  Duration m_monotonic;
  WallTime m_wall;
};

}  // namespace pitchboard::telemetry
