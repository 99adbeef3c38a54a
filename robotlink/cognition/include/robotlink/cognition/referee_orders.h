// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Derives from the referee's packets what a robot has to do, and writes it to the robot's
// blackboard. One thread at a time.

#include <optional>

#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// The values of COM_REFEREE.
inline constexpr int refereeStop = 1, refereePlay = 2, refereeReady = 11, refereeSet = 12;

/// What a packet tells a robot to do.
struct RefereeOrder {
  int code = refereeStop;                     ///< value of COM_REFEREE
  sim::SetPlay setPlay = sim::SetPlay::None;  ///< the current set play
  bool setPlayIsOurs = false;                 ///< the robot's team takes the set play
  int goalsOwn = 0, goalsTheirs = 0;
  int secondsLeft = 0;  ///< of this half
  bool operator==(const RefereeOrder&) const = default;
};

/// Writes orders to COM_REFEREE, and to COM_SET_PLAY, COM_SET_PLAY_OURS, COM_GOALS_OWN,
/// COM_GOALS_THEIRS and COM_SECONDS_LEFT of the extension if the map contains them.
class RefereeVariables {
 public:
  explicit RefereeVariables(const VariableCatalog& map);
  /// Writes set play, score and time only if `extended`, because other teams may use those words
  /// differently.
  void write(Blackboard& board, const RefereeOrder& order, bool extended) const;

 private:
  IntVar m_code, m_setPlay, m_setPlayIsOurs, m_goalsOwn, m_goalsTheirs, m_secondsLeft;
};

/// Follows the packets of a referee, of any version, for one robot. It remembers which team has the
/// ball in a restart, because after a set play has been executed, packets of the Humanoid League
/// name only the team of the last kick-off. A robot that starts later relies on the packet.
class RefereeOrders {
 public:
  /// Returns the order to the robot. `team` is its team's number at the referee, `player` its slot
  /// there, from 1. Penalised robots and substitutes are told to stop, as is everybody in INITIAL,
  /// FINISHED, a timeout, and while the game is stopped. Empty if the robot's team does not play in
  /// this match, and for true data (RGTD), which only monitors may use.
  std::optional<RefereeOrder> take(const telemetry::RefereeState& state, int team, int player);

  bool operator==(const RefereeOrders&) const = default;

 private:
  int codeInPlay(const telemetry::RefereeState& state, int team);

  std::optional<int> m_ballTeam;  // in the current restart; empty: the packet's kickOffTeam
};

}  // namespace pitchboard::link
