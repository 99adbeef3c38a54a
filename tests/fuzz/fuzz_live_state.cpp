// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as what a session keeps of a live match every 15 s: what is read of it makes a frame,
// and written again it reads back.
#include <cstdlib>

#include <robotlink/live/live_state.h>

using namespace pitchboard;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const telemetry::WallTime zero{std::chrono::seconds(1'700'000'000)};
  const auto read = link::LiveState::read({reinterpret_cast<const char*>(data), size}, zero);
  if (!read) return 0;
  const auto now = zero + std::chrono::seconds(15);
  const telemetry::TeamStatus status = read->state.monitor.status(now);
  if (status.robots.size() >
      read->options.team.maxRobots() + telemetry::MonitorOptions::ordinaryRobots)
    std::abort();
  const link::MatchFrame frame = read->state.frame(read->options, status, 15.0);
  if (frame.robots.size() != status.robots.size()) std::abort();
  const auto again = link::LiveState::read(read->state.text(read->options, 15.0, zero), zero);
  if (!again) std::abort();
  if (again->state.monitor.status(now).robots.size() != status.robots.size()) std::abort();
  return 0;
}
