// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts of a MatchFrame that exist only for robots and referees received by network. Plain values
// in metres and seconds; any thread.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/game.h>
#include <base/geometry.h>
#include <base/team_color.h>
#include <telemetry/monitor/link_health.h>

namespace pitchboard::link {

/// Why a robot may not play.
struct Penalty {
  PenaltyKind kind = PenaltyKind::None;
  int secondsLeft = 0;  ///< in packets as sent: some versions do not count down
  /// Returns whether it only waits to be brought on, which is no penalty.
  bool isSubstitute() const { return kind == PenaltyKind::Substitute; }
  bool operator==(const Penalty&) const = default;
};

/// Returns the penalty of a player of this game, also of a substitute; empty if it may play or is
/// null.
inline std::optional<Penalty> penaltyOf(const Game& game, const GamePlayer* player) {
  if (player == nullptr || player->penalty == PenaltyKind::None) return {};
  return Penalty{player->penalty, game.penaltySeconds(*player)};
}

/// A value of a robot's message.
struct ReceivedValue {
  std::string name;  ///< name in the profile, or OTHER_1, ...
  std::string text;  ///< as sent
  std::string unit;
  bool operator==(const ReceivedValue&) const = default;
};

/// A robot's reply to the referee, passed on in monitor mode or received directly.
struct RobotReplyView {
  int team = 0, player = 0;
  std::string address;
  bool fallen = false;
  std::optional<Pose> pose;       ///< as sent: m and rad in the robot's own frame of the field
  std::optional<double> ballAge;  ///< s
  double age = 0.0;               ///< s
};

/// How the packets of a referee are received.
struct RefereeReception {
  int version = 0, size = 0;  ///< of the packets
  std::string sender;
  bool simulated = false;               ///< it is the referee of a simulated match
  double age = 0.0;                     ///< s
  bool timedOut = false;                ///< the referee is offline; this is its last state
  bool conflict = false;                ///< a second referee program is sending
  std::optional<Game> truth;            ///< without the league's delays, from monitor mode
  double truthAge = 0.0;                ///< s
  std::vector<RobotReplyView> replies;  ///< by team and player
  int ourTeam = 0;  ///< number of our team; 0 if none was chosen or it does not play
};

/// Where the robots of a team agree that the ball is.
struct TeamBall {
  TeamColor team = TeamColor::Blue;
  Point position;                        ///< mean over the robots that agree
  double spread = 0.0;                   ///< m, root mean square distance from the mean
  int agree = 0;                         ///< robots within `reach` of each other's ball; at least 2
  int see = 0;                           ///< robots that see a ball at all
  static constexpr double reach = 0.75;  ///< m
};

}  // namespace pitchboard::link
