// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Derives from the referee's game what a robot has to do, and writes it to the robot's
// blackboard. One thread at a time.

#include <array>
#include <optional>
#include <string_view>

#include <base/game.h>
#include <robotlink/blackboard/robot_variables.h>

namespace pitchboard::link {

/// The values of COM_REFEREE.
inline constexpr int refereeStop = 1, refereePlay = 2, refereeReady = 11, refereeSet = 12;

/// Writes what a referee tells a robot: COM_REFEREE, and the game to COM_SET_PLAY,
/// COM_SET_PLAY_OURS, COM_GOALS_OWN, COM_GOALS_THEIRS and COM_SECONDS_LEFT of the extension if the
/// map contains them.
class RefereeVariables {
 public:
  static constexpr std::array<std::string_view, 6> names{"COM_REFEREE",       "COM_SET_PLAY",
                                                         "COM_SET_PLAY_OURS", "COM_GOALS_OWN",
                                                         "COM_GOALS_THEIRS",  "COM_SECONDS_LEFT"};
  explicit RefereeVariables(const VariableCatalog& map);
  /// `code`: value of COM_REFEREE; `team`: number of the robot's team, which plays. Writes set
  /// play, score and time only if `extended`, because other teams may use those words differently.
  void write(Blackboard& board, int code, const Game& game, int team, bool extended) const;

 private:
  IntVar m_code, m_setPlay, m_setPlayIsOurs, m_goalsOwn, m_goalsTheirs, m_secondsLeft;
};

/// Follows the game of a referee's packets, of any version, for one robot. It remembers which team
/// has the ball in a restart, because after a set play has been executed, packets of the Humanoid
/// League name only the team of the last kick-off. A robot that starts later relies on the packet.
class RefereeOrders {
 public:
  /// Returns the value of COM_REFEREE for the robot. `team` is its team's number at the referee,
  /// `player` its slot there, from 1. Penalised robots and substitutes are told to stop, as is
  /// everybody in INITIAL, FINISHED, a timeout, and while the game is stopped. Empty if the robot's
  /// team does not play in this match.
  std::optional<int> take(const Game& game, int team, int player);

  bool operator==(const RefereeOrders&) const = default;

 private:
  int codeInPlay(const Game& game, int team);

  std::optional<int> m_ballTeam;  // in the current restart; empty: the team of the kick-off
};

}  // namespace pitchboard::link
