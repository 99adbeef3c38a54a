// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a tally sees of a match at one moment, whatever its source: session_tally.h makes it of rows
// and frames. Unknown values are empty. Plain values in metres and seconds; any thread.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <base/game.h>
#include <base/geometry.h>
#include <base/robot_key.h>
#include <base/team_color.h>
#include <telemetry/monitor/team_monitor.h>

namespace pitchboard::link {

/// A robot has the ball while it is the nearest one and closer than this (m).
inline constexpr double ballReach = 0.5;
/// Time between two moments of a tally, s.
inline constexpr double tallyStep = 0.1;

/// A robot at one moment. What is unknown is empty.
struct TallyRobot {
  RobotUid uid;
  std::string name;  ///< of its group: "B1"
  std::string ownName{};
  RobotOrder order;
  TeamColor team = TeamColor::Blue;
  std::optional<Point> place{};                      ///< true, else believed
  double placeTime = 0.0;                            ///< s, when it was there; of believed places
  std::optional<double> walked{}, kicks{}, falls{};  ///< counters of a simulated robot
  bool kicking = false, fallen = false, penalised = false;
  bool tellsKicks = false;                  ///< kicks or kicking say when it kicks
  PenaltyKind penalty = PenaltyKind::None;  ///< why it is penalised, if that is known
  double sigma = 0.0;                       ///< m, uncertainty of a believed place
  double radius = 0.0;                      ///< m; 0: that of the field
  std::optional<double> beliefError{};      ///< cm
  std::optional<double> ballDistance{};     ///< m, true, else as it sees the ball itself
  /// Whether each process works.
  std::array<std::optional<bool>, telemetry::processCount> works{};
  std::optional<telemetry::LinkHealth> link{};  ///< of a live robot
  std::optional<double> volts{};
};

struct TallyTeam {
  std::string name{};
  std::optional<int> number{}, score{};  ///< number: the referee's
  std::optional<bool> attacksRight{};    ///< it plays towards the goal at +x
};

/// A set play or kick-off that a team is about to take.
struct TallyRestart {
  SetPlay kind = SetPlay::None;  ///< None: a kick-off
  TeamColor team = TeamColor::Blue;
  bool operator==(const TallyRestart&) const = default;
};

struct TallyMoment {
  double time = 0.0;
  std::vector<TallyRobot> robots;
  std::map<TeamColor, TallyTeam> teams;
  std::optional<Point> ball;
  double ballSigma = 0.0;  ///< m, uncertainty of a ball that robots report
  std::optional<TallyRestart> restart{};
  bool isInPlay = true;             ///< false: a kick now is no pass
  std::optional<std::size_t> half;  ///< 0 and 1, in extra time 2 and 3; empty: no half is played
};

}  // namespace pitchboard::link
