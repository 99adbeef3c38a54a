// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a datagram on the referee's port.
#include <telemetry/referee/referee_tracker.h>

#include <cstdlib>

using namespace pitchboard::telemetry;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static RefereeTracker tracker;
  static WallTime now{std::chrono::seconds(1'700'000'000)};
  now += std::chrono::milliseconds(100);
  const auto packet = decodeReferee(std::as_bytes(std::span(data, size)));
  if (!packet) {
    if (packet.error().message.empty()) std::abort();
    return 0;
  }
  if (const auto* state = std::get_if<RefereeState>(&*packet)) {
    (void)tracker.accept(*state, {{1}, 3838}, now);
    for (const RefereeTeam& team : state->teams) {
      for (const RefereePlayer& player : team.players()) {
        if (penaltyName(*state, player.penalty).empty()) std::abort();
      }
    }
  }
  return 0;
}
