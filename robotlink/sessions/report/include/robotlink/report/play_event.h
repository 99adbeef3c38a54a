// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a coach counts in a match: who passed to whom, shot, won the ball, and what came of set
// plays. docs/statistics.md defines each kind. Metres and seconds of the source; plain values; any
// thread.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/robot_key.h>
#include <base/team_color.h>

namespace pitchboard::link {

/// The comments say what `other` and `end` are.
enum class PlayKind : std::uint8_t {
  Goal,     ///< robot: touched the ball last, maybe of the other team; none if nobody did
  Shot,     ///< other: who stopped it; end: of the ball's way
  Pass,     ///< other: who got the ball; end: when
  BallWon,  ///< other: who lost the ball
  SetPlay,  ///< robot: who played the ball first; end: of what came of it; detail: "corner kick"
  Penalty,  ///< end: when the robot was back; detail: the reason
  Offline   ///< from the last message to `end`, the next one
};
inline constexpr std::size_t playKindCount = 7;

enum class PlayOutcome : std::uint8_t {
  None,
  Completed,    ///< a team-mate got the ball
  Intercepted,  ///< an opponent did
  Out,          ///< the ball left the field, or play was stopped
  Goal,
  Saved,  ///< a shot between the posts that was no goal
  Wide,   ///< a shot past the goal
  Shot,   ///< a set play that led to a shot
  Kept,   ///< the team still had the ball
  Lost,   ///< the other team got the ball
  GoesOn  ///< not over when the range ends
};
inline constexpr std::size_t playOutcomeCount = 11;

struct PlayEvent {
  PlayKind kind = PlayKind::Pass;
  PlayOutcome outcome = PlayOutcome::None;
  double time = 0.0, end = 0.0;
  TeamColor team = TeamColor::Blue;   ///< who kicked, won the ball, takes the set play or scored
  RobotUid robot{}, other{};          ///< 0: none, or unknown
  std::string name{}, otherName{};    ///< "B1"
  std::optional<Point> from{}, to{};  ///< where it began, and where the ball was at `end`
  /// m, uncertainty of `from`: of what robots believe and see, 0 of the truth.
  double sigma = 0.0;
  std::string detail{};
  bool operator==(const PlayEvent&) const = default;
};

/// Identifiers for files, and words for people: "ball-won", "ball won".
std::string_view nameOf(PlayKind kind);
std::string_view nameOf(PlayOutcome outcome);
std::string_view labelOf(PlayKind kind);
std::string_view labelOf(PlayOutcome outcome);
/// Returns a sentence: "B2 passes to B3 (2.1 m)", "B1 shoots from 3.2 m: saved by R1".
std::string sentenceOf(const PlayEvent& event);
/// Returns a table for other programs, with a line for each event.
std::string playCsv(const std::vector<PlayEvent>& events);

/// The last seconds before a goal, for its picture.
struct GoalScene {
  struct Path {
    std::string name;  ///< of the robot
    TeamColor team = TeamColor::Blue;
    std::vector<Point> points;
  };
  PlayEvent goal;
  std::vector<Point> ball;
  std::vector<Path> robots;
};

}  // namespace pitchboard::link
