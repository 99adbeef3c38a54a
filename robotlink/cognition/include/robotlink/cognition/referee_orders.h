// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a referee's packets say to one robot, and where that stands on its blackboard. Any thread,
// one at a time.

#include <optional>

#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/game_state.h>
#include <telemetry/wire/gamecontroller.h>

namespace pitchboard::link {

/// The words that COM_REFEREE knows (system.md section 6).
inline constexpr int refereeStop = 1, refereePlay = 2, refereeReady = 11, refereeSet = 12;

/// What one packet means to one robot.
struct RefereeOrder {
  int word = refereeStop;                     ///< 1 stop, 2 play, 11 ready, 12 set
  sim::SetPlay setPlay = sim::SetPlay::None;  ///< that the referee has given
  bool setPlayIsOurs = false;                 ///< the robot's team takes it
  int goalsOwn = 0, goalsTheirs = 0;
  int secondsLeft = 0;  ///< of this half
  bool operator==(const RefereeOrder&) const = default;
};

/// Where an order stands: COM_REFEREE, and of the extension, where the map has them, COM_SET_PLAY,
/// COM_SET_PLAY_OURS, COM_GOALS_OWN, COM_GOALS_THEIRS and COM_SECONDS_LEFT.
class RefereeVariables {
 public:
  explicit RefereeVariables(const VariableCatalog& map);
  /// `extended`: set play, score and time, too. Other robots may keep something else on those
  /// words.
  void write(Blackboard& board, const RefereeOrder& order, bool extended) const;

 private:
  IntVar m_word, m_setPlay, m_setPlayIsOurs, m_goalsOwn, m_goalsTheirs, m_secondsLeft;
};

/// Hears the packets of one robot's referee, of any version. Remembers whose ball a restart is:
/// once a set play is executed the packets of the Humanoid League name the side of the last
/// kick-off only. A robot that starts in the middle believes them.
class RefereeOrders {
 public:
  /// What this packet means to the robot. `team` is the number in the GameController, `player` the
  /// slot of the robot there, from 1. A penalised robot, and a substitute, stands (1), as does
  /// everybody in INITIAL, FINISHED, a timeout and while the game is stopped. Nothing when the
  /// packet is not for this robot's match: its team does not play, or it is true data (RGTD), which
  /// only monitors may use.
  std::optional<RefereeOrder> take(const telemetry::RefereeState& state, int team, int player);

  bool operator==(const RefereeOrders&) const = default;

 private:
  int wordInPlay(const telemetry::RefereeState& state, int team);

  std::optional<int> m_ballTeam;  ///< of the restart that goes on; nothing: kickOffTeam's
};

}  // namespace pitchboard::link
