// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a referee's packets say to one robot, as the one word that stands on its blackboard. Any
// thread, one at a time.

#include <optional>

#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// The words that COM_REFEREE knows (system.md section 6).
inline constexpr int refereeStop = 1, refereePlay = 2, refereeReady = 11, refereeSet = 12;

/// Hears the packets of one robot's referee, of any version. Remembers whose ball a restart is:
/// once a set play is executed the packets of the Humanoid League name the side of the last
/// kick-off only. A robot that starts in the middle believes them.
class RefereeOrders {
 public:
  /// What this packet means to the robot: 1 stop, 2 play, 11 ready, 12 set. `team` is the number in
  /// the GameController, `player` the slot of the robot there, from 1. A penalised robot, and a
  /// substitute, stands (1), as does everybody in INITIAL, FINISHED, a timeout and while the game
  /// is stopped. Nothing when the packet is not for this robot's match: its team does not play, or
  /// it is true data (RGTD), which only monitors may use.
  std::optional<int> take(const telemetry::RefereeState& state, int team, int player);

  bool operator==(const RefereeOrders&) const = default;

 private:
  int wordInPlay(const telemetry::RefereeState& state, int team);

  std::optional<int> m_ballTeam;  ///< of the restart that goes on; nothing: kickOffTeam's
};

}  // namespace pitchboard::link
