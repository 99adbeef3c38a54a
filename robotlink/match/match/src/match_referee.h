// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a match's robots hear its referee: packets to the match's port, as the GameController sends
// them, and COM_REFEREE on the blackboards of inline robots, in the same rhythm. Or the other way
// round: receives a GameController's packets and makes the game obey them. Private to the module;
// on the match's thread.

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include <base/result.h>
#include <robotlink/match/robots_memory.h>
#include <simcore/simulation/simulation.h>
#include <telemetry/referee/referee_tracker.h>
#include <telemetry/sockets/udp_receiver.h>
#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::link {

class MatchReferee {
 public:
  /// Sends to every process of this computer that listens on `port`.
  Result<void> sendTo(int port);
  /// Obeys the GameController that sends to `port`, which alone referees the game.
  Result<void> obey(int port, sim::Simulation& simulation);
  /// Robots answer what they obey: to this port of the sender, or 0 for that of the version.
  void answerTo(int port) { m_answerPort = port; }

  /// After a tick: takes what a GameController has said, and sends what is due. True when
  /// robots receive a packet now: heard() is new. A tick that is played `again` receives and sends
  /// nothing.
  bool tick(sim::Simulation& simulation, bool again = false);
  const RefereeRhythm& rhythm() const { return m_rhythm; }
  void setRhythm(const RefereeRhythm& rhythm) { m_rhythm = rhythm; }
  /// The game as robots hear it.
  const Game& heard() const { return m_heardGame; }

 private:
  void send();
  bool listen(sim::Simulation& simulation);
  void answer(const sim::Simulation& simulation);

  using Clock = std::chrono::steady_clock;

  std::optional<telemetry::UdpSender> m_sender;
  std::uint16_t m_port = 0;
  std::unique_ptr<telemetry::UdpReceiver> m_receiver;
  telemetry::RefereeTracker m_tracker;
  telemetry::DatagramBatch m_batch;
  telemetry::RefereeState m_packet;
  Game m_heardGame;  // of m_packet
  /// Plus 1 for every packet sent, also after a jump back in time: who listens takes lower numbers
  /// for late packets.
  int m_nextNumber = 0;
  std::optional<int> m_answerPort;
  std::optional<telemetry::UdpSender> m_answers;
  telemetry::Address m_controller;  // to which m_answers go
  std::optional<Clock::time_point> m_heard, m_answered;
  RefereeRhythm m_rhythm;
};

}  // namespace pitchboard::link
