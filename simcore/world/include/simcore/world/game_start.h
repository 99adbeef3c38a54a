// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where in a game a match begins: any state, with its clock, score, set play, penalties and cards.
// Says only what differs from the beginning of a match by the same rules; scenario files have it
// under "game" (docs/scenarios.md). Seconds of simulated time, metres. Plain values, any thread.

#include <array>
#include <map>
#include <optional>
#include <vector>

#include <base/geometry.h>
#include <base/ids.h>
#include <simcore/world/game_state.h>
#include <simcore/world/team_color.h>

namespace pitchboard::sim {

struct GameStart {
  struct Robot {
    PenaltyKind penalty = PenaltyKind::None;
    std::optional<double> left{};  ///< nothing: as from the call
    double since = 0.0;            ///< since the call
    bool outside = false;          ///< it has been put beside the field
    std::optional<bool> counts{};  ///< its time goes by; nothing: as the rules have it
    int warnings = 0, yellow = 0, red = 0, cautions = 0;
    std::optional<bool> goalkeeper{};  ///< nothing: who stands nearest to the goal
    bool operator==(const Robot&) const = default;
  };
  struct Team {
    int score = 0;
    std::optional<std::array<int, 4>> byHalf{};  ///< nothing: all goals are of this half
    int shots = 0;                               ///< of a shoot-out
    int scored = 0;                              ///< a bit for each shot that scored
    int timeouts = 0;                            ///< in this half
    int removals = 0;                            ///< those that make the next ones longer
    bool operator==(const Team&) const = default;
  };
  /// A set play, or the ball of a kick-off (SetPlay::None).
  struct Taking {
    SetPlay kind = SetPlay::None;
    std::optional<TeamColor> team{};
    std::optional<Restart::Step> step{};  ///< nothing: it begins, as by the referee's call
    std::optional<Point> place{};         ///< nothing: where the ball is
    RobotId kicker{};
    bool passed = false, onlyTaker = false;
    bool operator==(const Taking&) const = default;
  };
  struct Rest {
    std::optional<Point> place{};  ///< nothing: where the ball is
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
  /// Who kicks off; a drop ball is nobody's.
  struct KickOff {
    std::optional<TeamColor> team{};
    bool operator==(const KickOff&) const = default;
  };

  PlayState state = PlayState::Initial;
  GamePhase phase = GamePhase::Normal;
  GamePhase phaseBefore = GamePhase::Normal;  ///< a timeout
  int half = 1;
  // What is left out follows from the rules and the state: a READY lasts its whole time.
  std::optional<double> clock{};  ///< left of the half; negative after its end
  std::optional<ClockUse> clockUse{};
  std::optional<double> stateTime{};  ///< since the state, or the step of the set play, began
  std::optional<double> countdown{};
  std::optional<bool> countdownRuns{};
  std::optional<double> hidden{}, breakLeft{};
  std::optional<TeamColor> left{};  ///< who defends the left goal
  std::optional<TeamColor> firstKickOff{};
  std::optional<KickOff> kickOff{};
  std::optional<Taking> setPlay{};
  std::optional<TeamColor> shooter{};  ///< of a shoot-out: who has the shot
  std::optional<DropIn> dropIn{};
  std::optional<Touch> touch{};
  std::optional<Rest> ballStill{}, ballNear{};
  double ballAlone = 0.0;
  bool stopped = false, over = false;
  std::map<TeamColor, Team> teams{};
  std::map<RobotId, Robot> robots{};  ///< those of which there is something to say
  bool operator==(const GameStart&) const = default;
};

}  // namespace pitchboard::sim
