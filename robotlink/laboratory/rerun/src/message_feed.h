// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sends the recorded datagrams of the referee and of other robots again at their recorded times, to
// the ports on which they came, for separate programs that listen. They stay on this computer.
// Private to the module; one thread. Seconds of the session.

#include <deque>
#include <optional>
#include <string>

#include <telemetry/session/session_reader.h>
#include <telemetry/sockets/udp_sender.h>

#include "recorded_robot.h"

namespace pitchboard::link {

/// Returns whether a process of this name gets more than what stands on the blackboard.
bool hearsMessages(const std::string& process);

class MessageFeed {
 public:
  /// Returns how many datagrams the recording has.
  static std::uint64_t count(const telemetry::SessionReader& session);
  /// Fails with SystemError.
  static Result<MessageFeed> start(const telemetry::SessionReader& session,
                                   const RecordedRobot& recorded);
  /// Reads those of a part of the session.
  void read(const telemetry::SessionReader& session, double from, double until);
  /// Sends what came up to this time.
  void sendTo(double time);

 private:
  MessageFeed(telemetry::UdpSender sender, std::string own)
      : m_sender(std::move(sender)), m_own(std::move(own)) {}

  telemetry::UdpSender m_sender;
  std::string m_own;  // address of the robot itself, whose messages it did not get; may be empty
  std::deque<telemetry::SessionDatagram> m_waiting;
};

}  // namespace pitchboard::link
