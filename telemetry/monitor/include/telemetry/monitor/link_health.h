// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The link of one robot, and whether its processes work. TeamMonitor makes these values, and frames
// carry them to the screen. Plain values that may cross threads.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <telemetry/monitor/battery.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

enum class HeartbeatState : std::uint8_t { Unknown, Working, NotResponding };

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
  std::vector<Sender> others;  ///< senders that currently send the same messages
  bool timedOut = false;
  Duration age{};                ///< time since the last usable message
  std::uint64_t messages = 0;    ///< usable messages; 0 in a recording, which does not count them
  std::uint64_t bytes = 0;       ///< payload of all messages
  std::uint64_t errorCount = 0;  ///< messages with errors
  std::uint64_t recoveries = 0;  ///< how often it came back after a timeout
  Duration offline{};          ///< how long these outages lasted together, from message to message
  double rate = 0.0;           ///< messages per second
  double jitter = 0.0;         ///< s
  std::optional<double> loss;  ///< 0 to 1, if the profile has a sequence number
  std::uint64_t lost = 0;
  std::uint64_t duplicates = 0;  ///< messages that arrived twice
  std::uint64_t late = 0;        ///< messages that arrived after a newer one; they change no value
};

/// Marks two senders of the same number as conflicting if neither has timed out.
inline void noteConflict(LinkHealth& a, LinkHealth& b) {
  if (!a.timedOut && !b.timedOut) a.conflict = b.conflict = true;
}

}  // namespace pitchboard::telemetry
