// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts of a MatchFrame that exist only for robots and referees received by network. Plain values
// in metres and seconds; any thread.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/geometry.h>
#include <simcore/world/team_color.h>
#include <telemetry/wire/gamecontroller.h>
#include <telemetry/wire/link_health.h>

namespace pitchboard::link {

/// A robot's penalty in the referee's packet.
struct Penalty {
  std::string text;     ///< such as "pickup or incapable"
  int secondsLeft = 0;  ///< as sent; some packet versions do not count down
  bool operator==(const Penalty&) const = default;
};

/// A value of a robot's message.
struct ReceivedValue {
  std::string name;  ///< name in the profile, or OTHER_1, ...
  std::string text;  ///< as sent
  std::string unit;
  bool operator==(const ReceivedValue&) const = default;
};

/// A player in a team's list, which does not contain waiting substitutes.
struct RefereePlayerView {
  int number = 0;
  std::string penalty;  ///< such as "pickup or incapable"; empty: the player may play
  int secondsLeft = 0;  ///< as sent
  int warnings = 0, yellow = 0, red = 0, cautions = 0;
  bool goalkeeper = false;
  bool operator==(const RefereePlayerView&) const = default;
};

struct RefereeTeamView {
  int number = 0;
  std::string colour;  ///< such as "blue"; "unknown" for an unknown code
  int score = 0;
  int playersLeft = 0;  ///< players on the field that are not penalised, including substitutes
  std::vector<RefereePlayerView> players{};
  std::string name{};  ///< from the team setup or the scenario; may be empty
};

/// The true state of the game without the league's delays, from monitor mode.
struct RefereeTruth {
  std::string state;
  std::string setPlay;
  int secondsLeft = 0;
  std::optional<int> secondaryTime;
  std::array<int, 2> scores{};
  double age = 0.0;  ///< s
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

/// The state of the game in the referee's packets.
struct RefereeView {
  int version = 0;
  std::string sender;
  double age = 0.0;                     ///< s
  bool timedOut = false;                ///< the referee is offline; this is its last state
  bool conflict = false;                ///< a second referee program is sending
  std::optional<RefereeTruth> truth;    ///< set if true data are received in monitor mode
  std::vector<RobotReplyView> replies;  ///< by team and player
  std::string state;                    ///< "PLAYING"
  std::string setPlay;  ///< such as "corner", "direct free kick", "timeout"; empty in normal play
  std::string phase;    ///< "overtime", "penalty shoot-out"; empty in normal time
  bool firstHalf = true;
  bool stopped = false;
  int secondsLeft = 0;  ///< negative in extra time
  std::optional<int> secondaryTime;
  std::string countdown;                 ///< event at the end of secondaryTime, such as "ball free"
  std::optional<int> performingTeam;     ///< number of the team that takes the set play
  std::string setPlayStep;               ///< "stop", "prepare", "ready"; empty if not sent
  std::optional<int> kickOffTeam;        ///< team number
  std::array<RefereeTeamView, 2> teams;  ///< left, right
  int ourTeam = 0;  ///< number of our team; 0 if none was chosen or it does not play
  std::optional<telemetry::RefereeState> packet;  ///< the packet that all of this comes from
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
