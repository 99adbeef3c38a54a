// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How well one robot is heard, and whether its processes work: values that the TeamMonitor makes,
// and that are carried as they are to frames and screens. They may cross threads.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <telemetry/wire/battery.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

enum class HeartbeatState : std::uint8_t { Unknown, Working, Silent };

/// Control, vision, localization, decision, IMU: the order of the message.
inline constexpr std::size_t processCount = 5;
inline constexpr std::array<std::string_view, processCount> processNames{
    "Control", "Vision", "Localization", "Decision", "IMU"};

struct ProcessHeartbeat {
  HeartbeatState state =
      HeartbeatState::Unknown;  ///< Unknown: not in the message, or robot timed out
  double probability = 0.5;
  Duration since{};  ///< how long it has been in this state
};

struct LinkHealth {
  Sender sender;
  bool conflict = false;       ///< another sender uses the same number at the moment
  std::vector<Sender> others;  ///< that send the same at the moment
  bool timedOut = false;
  Duration age{};                ///< since the last usable message
  std::uint64_t messages = 0;    ///< usable ones; 0 in a recording, which does not count them
  std::uint64_t bytes = 0;       ///< of all, payload only
  std::uint64_t errorCount = 0;  ///< messages with errors
  std::uint64_t recoveries = 0;  ///< times it came back
  double rate = 0.0;             ///< messages per second
  double jitter = 0.0;           ///< s
  std::optional<double> loss;    ///< 0 to 1, where the profile has a sequence number
  std::uint64_t lost = 0;
  std::uint64_t duplicates = 0;  ///< that came twice
  std::uint64_t late = 0;        ///< older than one that came before; they change no value
};

/// Of two senders that use the same number: they are in conflict while both are heard.
inline void noteConflict(LinkHealth& a, LinkHealth& b) {
  if (!a.timedOut && !b.timedOut) a.conflict = b.conflict = true;
}

}  // namespace pitchboard::telemetry
