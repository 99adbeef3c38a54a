// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/sockets/live_clock.h>

#include <algorithm>
#include <ctime>

namespace pitchboard::telemetry {
namespace {

/// No datagram waits longer than this in the kernel: a program that is stopped for so long has
/// other troubles.
constexpr Duration maxWait = std::chrono::minutes(1);

Duration read(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

ClockSource ClockSource::system() {
  return {[] { return read(CLOCK_BOOTTIME); }, [] { return WallTime(read(CLOCK_REALTIME)); }};
}

LiveClock::LiveClock(ClockSource source)
    : m_source(std::move(source)), m_monotonic(m_source.monotonic()), m_wall(m_source.wall()) {}

WallTime LiveClock::arrival(WallTime stamp) const {
  const Duration waited = m_source.wall() - stamp;
  const WallTime here = now();
  return waited < Duration::zero() || waited > maxWait ? here : here - waited;
}

}  // namespace pitchboard::telemetry
