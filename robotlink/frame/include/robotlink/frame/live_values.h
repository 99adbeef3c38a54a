// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known only of robots and referees that are heard by network: parts of a MatchFrame.
// Plain values, studio units (metres, seconds).

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

/// A robot's penalty as the referee says it.
struct Penalty {
  std::string words;    ///< "pickup or incapable"
  int secondsLeft = 0;  ///< as sent: some versions do not count down
  bool operator==(const Penalty&) const = default;
};

/// One value of a robot's message that is not a field of its own elsewhere.
struct ReceivedValue {
  std::string name;  ///< as in the profile, or OTHER_1, ...
  std::string text;  ///< as sent
  std::string unit;
  bool operator==(const ReceivedValue&) const = default;
};

/// One player of a team's list; substitutes that wait are not in it.
struct RefereePlayerView {
  int number = 0;
  std::string penalty;  ///< "pickup or incapable"; empty: it plays
  int secondsLeft = 0;  ///< as sent
  int warnings = 0, yellow = 0, red = 0, cautions = 0;
  bool goalkeeper = false;
  bool operator==(const RefereePlayerView&) const = default;
};

struct RefereeTeamView {
  int number = 0;
  std::string colour;  ///< "blue"; "unknown" for a code nobody knows
  int score = 0;
  int playersLeft = 0;  ///< on the field: not penalised, substitutes that came in counted
  std::vector<RefereePlayerView> players{};
  std::string name{};  ///< of the team setup or the scenario; empty: it has none
};

/// What really happens, without the league's delays: monitor mode.
struct RefereeTruth {
  std::string state;
  std::string setPlay;
  int secondsLeft = 0;
  std::optional<int> secondaryTime;
  std::array<int, 2> scores{};
  double age = 0.0;  ///< s
};

/// What a robot told the referee, passed on in monitor mode or heard directly.
struct RobotReplyView {
  int team = 0, player = 0;
  std::string address;
  bool fallen = false;
  std::optional<Pose> pose;       ///< as its message says: m, rad, its own frame of the field
  std::optional<double> ballAge;  ///< s
  double age = 0.0;               ///< s
};

/// The state of the game as the referee sends it.
struct RefereeView {
  int version = 0;
  std::string sender;
  double age = 0.0;                     ///< s
  bool timedOut = false;                ///< shown as it was last heard
  bool conflict = false;                ///< a second controller is heard
  std::optional<RefereeTruth> truth;    ///< monitor mode works: true data are received as well
  std::vector<RobotReplyView> replies;  ///< by team and player
  std::string state;                    ///< "PLAYING"
  std::string setPlay;  ///< "corner", "direct free kick", "timeout"; empty in normal play
  std::string phase;    ///< "overtime", "penalty shoot-out"; empty in normal time
  bool firstHalf = true;
  bool stopped = false;
  int secondsLeft = 0;  ///< negative in extra time
  std::optional<int> secondaryTime;
  std::string countdown;              ///< what secondaryTime counts down to: "ball free"; or empty
  std::optional<int> performingTeam;  ///< number of the team that takes the set play
  std::string setPlayStep;            ///< "stop", "prepare", "ready"; empty: not said
  std::optional<int> kickOffTeam;     ///< team number
  std::array<RefereeTeamView, 2> teams;  ///< left, right
  int ourTeam = 0;  ///< chosen number; 0 when none was chosen or it does not play
  std::optional<telemetry::RefereeState> packet;  ///< all of this comes from
};

/// Where the robots of a team think that the ball is, taken together.
struct TeamBall {
  TeamColor team = TeamColor::Blue;
  Point position;                        ///< mean of those that agree
  double spread = 0.0;                   ///< m, root mean square distance from the mean
  int agree = 0;                         ///< robots within `reach` of each other's ball; at least 2
  int see = 0;                           ///< robots that see a ball at all
  static constexpr double reach = 0.75;  ///< m
};

}  // namespace pitchboard::link
