// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Describes the situation in which a match starts: state, clock, score, set play, penalties and
// cards. It holds only what differs from the normal start of a match by the same rules; an empty
// optional means "as the rules and the state imply". Scenario files have it under "game"
// (docs/scenarios.md). startGame() makes a Game of it, and gameStartOf() describes a Game; it is
// none itself, because who writes a file names robots and colours, and leaves out what follows from
// rules that may change. Seconds of simulated time, metres. Plain values; any thread.

#include <array>
#include <map>
#include <optional>
#include <vector>

#include <base/game.h>
#include <base/geometry.h>
#include <base/ids.h>
#include <base/team_color.h>

namespace pitchboard::sim {

struct GameStart {
  struct Robot {
    PenaltyKind penalty = PenaltyKind::None;
    std::optional<double> left{};  ///< remaining time; empty: the whole time of the penalty
    double since = 0.0;            ///< time since the call
    bool outside = false;          ///< the robot has been put beside the field
    std::optional<bool> counts{};  ///< whether the remaining time counts down
    int warnings = 0, yellow = 0, red = 0, cautions = 0;
    std::optional<bool> goalkeeper{};  ///< empty: the robot nearest to the goal is the goalkeeper
    bool operator==(const Robot&) const = default;
  };
  struct Team {
    int score = 0;
    std::optional<std::array<int, 4>> byHalf{};  ///< empty: all goals fell in this half
    int shots = 0;                               ///< shots taken in the shoot-out
    int scored = 0;                              ///< bit i is set if shot i scored
    int timeouts = 0;                            ///< taken in this half
    int removals = 0;                            ///< earlier removals; they make later ones longer
    bool operator==(const Team&) const = default;
  };
  /// Who takes a set play, or a kick-off (SetPlay::None), and how far it has progressed.
  struct Taking {
    SetPlay kind = SetPlay::None;
    std::optional<TeamColor> team{};
    std::optional<Restart::Step> step{};  ///< empty: it starts now, as if the referee called it
    std::optional<Point> place{};         ///< empty: where the ball is
    RobotId kicker{};
    bool passed = false, onlyTaker = false;
    bool operator==(const Taking&) const = default;
  };
  struct Rest {
    std::optional<Point> place{};  ///< empty: where the ball is
    double time = 0.0;
    bool operator==(const Rest&) const = default;
  };
  struct Touch {
    RobotId robot{};
    double ago = 0.0;
    bool operator==(const Touch&) const = default;
  };
  struct DropIn {
    TeamColor team{};
    double ago = 0.0;
    bool operator==(const DropIn&) const = default;
  };
  /// Which team kicks off; empty means a drop ball.
  struct KickOff {
    std::optional<TeamColor> team{};
    bool operator==(const KickOff&) const = default;
  };

  PlayState state = PlayState::Initial;
  GamePhase phase = GamePhase::Normal;
  GamePhase phaseBefore = GamePhase::Normal;  ///< phase to return to after a timeout
  int half = 1;
  // Whatever is empty follows from the rules and the state: a READY lasts its whole time.
  std::optional<double> clock{};  ///< time left of the half; negative after its end
  std::optional<ClockUse> clockUse{};
  std::optional<double> stateTime{};  ///< time since the state or the step of the set play began
  std::optional<double> countdown{};
  std::optional<bool> countdownRuns{};
  std::optional<double> hidden{};     ///< for how long robots are not told yet that play has begun
  std::optional<double> breakLeft{};  ///< time left of the break between halves
  std::optional<TeamColor> left{};    ///< the team that defends the left goal
  std::optional<TeamColor> firstKickOff{};
  std::optional<KickOff> kickOff{};
  std::optional<Taking> setPlay{};
  std::optional<TeamColor> shooter{};  ///< the team whose shot it is in a shoot-out
  std::optional<DropIn> dropIn{};      ///< who put the ball out, in leagues without set plays
  std::optional<Touch> touch{};        ///< who touched the ball last
  std::optional<Rest> ballStill{};     ///< since when the ball has hardly moved
  std::optional<Rest> ballNear{};      ///< since when the ball has been held up among robots
  double ballAlone = 0.0;              ///< for how long no robot has been near the ball
  bool stopped = false, over = false;
  std::map<TeamColor, Team> teams{};
  std::map<RobotId, Robot> robots{};  ///< robots that differ from the normal start
  bool operator==(const GameStart&) const = default;
};

}  // namespace pitchboard::sim
