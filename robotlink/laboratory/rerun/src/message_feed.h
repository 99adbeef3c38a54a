// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Gives the recorded datagrams of the referee and of other robots again at their recorded times: to
// separate programs on the ports on which they came, on this computer only, and the referee's to
// our communication inside this program. Private to the module; one thread. Seconds of the session.

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <telemetry/session/session_reader.h>
#include <telemetry/sockets/datagram.h>
#include <telemetry/sockets/udp_sender.h>

#include "feed.h"
#include "recorded_robot.h"

namespace pitchboard::link {

/// Returns whether a process of this name gets more than what stands on the blackboard.
bool hearsMessages(const std::string& process);

class MessageFeed {
 public:
  /// Returns how many datagrams the recording has.
  static std::uint64_t count(const telemetry::SessionReader& session);
  /// `sends`: separate programs listen. Fails with SystemError.
  static Result<MessageFeed> start(const telemetry::SessionReader& session,
                                   const RecordedRobot& recorded, bool sends);
  /// Returns the number that the robot's team had at the referee; empty if no packet tells.
  static std::optional<int> refereeTeam(const telemetry::SessionReader& session,
                                        const RecordedRobot& recorded);
  /// Returns whether communication also told the robot set play, score and time.
  static bool tellsSetPlay(const telemetry::SessionReader& session, const RecordedRobot& recorded);
  /// Reads those of a part of the session.
  void read(const telemetry::SessionReader& session, double from, double until);
  /// Sends what came up to this time.
  void sendTo(double time);
  /// As ProcessOptions::refereeDatagrams: what sendTo() added since the last call.
  std::function<bool(telemetry::DatagramBatch&)> refereeDatagrams() const;

 private:
  struct Waiting {
    telemetry::SessionDatagram datagram;
    bool isReferee = false;
  };

  std::optional<telemetry::UdpSender> m_sender;  // if separate programs listen
  std::string m_own;  // address of the robot itself, whose messages it did not get; may be empty
  std::deque<Waiting> m_waiting;
  std::shared_ptr<telemetry::DatagramBatch> m_inside = std::make_shared<telemetry::DatagramBatch>();
};

}  // namespace pitchboard::link
