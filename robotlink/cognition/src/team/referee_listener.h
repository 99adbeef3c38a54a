// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Hears the GameController for one robot: packets of every version in, the word for COM_REFEREE
// out.

#include <memory>
#include <optional>

#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/cognition/referee_orders.h>
#include <telemetry/wire/referee_tracker.h>
#include <telemetry/wire/udp_receiver.h>

namespace pitchboard::link {

/// Listens on a UDP port that it shares with others of this computer: each hears every broadcast.
/// While the port cannot be had it is tried again every few seconds.
class RefereeListener {
 public:
  /// Listens to options.refereePort for options.refereeTeam and options.shirt. Fails when the
  /// numbers are out of range or the system gives no means to receive.
  static Result<std::unique_ptr<RefereeListener>> start(const ProcessOptions& options);

  /// What the newest packet since the last call means to this robot; nothing when there was none
  /// for it. Never waits. A referee that falls silent has said its last word: it stays.
  std::optional<int> newWord();

 private:
  RefereeListener(int team, int player, std::unique_ptr<telemetry::UdpReceiver> receiver)
      : m_team(team), m_player(player), m_receiver(std::move(receiver)) {}

  int m_team, m_player;
  std::unique_ptr<telemetry::UdpReceiver> m_receiver;
  RefereeOrders m_orders;
  telemetry::RefereeTracker m_tracker;  // two versions at once, a second controller
  telemetry::DatagramBatch m_batch;
};

}  // namespace pitchboard::link
