// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Something that happened in a simulated, live or recorded match. The event is made where it
// happens (SimulatedMatch, LiveWatch, the user) and passed unchanged to timeline, log, session
// file, report and command line. The functions below make text of it, which is only shown and never
// parsed. Times are seconds of the source. Plain values; any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/log_line.h>
#include <base/robot_key.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// The comments say which members of MatchEvent a kind uses.
enum class MatchEventKind : std::uint8_t {
  Goal,                  ///< side, team, score
  ScoreCorrected,        ///< side, team, score
  BallOut,               ///< none
  Kick,                  ///< robot; value: the action
  Fall,                  ///< robot
  GotUp,                 ///< robot
  UnknownAction,         ///< robot; value: the code
  BallSeen,              ///< robot: it sees the ball again
  BallLost,              ///< robot: it has not seen the ball for BallSight::lostAfter
  GameState,             ///< detail: "PLAYING"; value: seconds left, if there is a clock
  MatchOver,             ///< detail: the stop condition of the scenario that was met
  Half,                  ///< value: 1 or 2
  SetPlay,               ///< detail: "corner"; empty: normal play again
  GamePhase,             ///< detail: "penalty shoot-out"; empty: normal time
  PlayStopped,           ///< none; the referee stopped play
  PlayGoesOn,            ///< none; the referee resumed play
  RefereeReceived,       ///< a first or different referee; detail: which; value: packet version
  RefereeOffline,        ///< none
  RefereeBack,           ///< none
  SecondReferee,         ///< detail: the referee that is shown
  RobotReceived,         ///< robot: first message; detail: its sender
  RobotOffline,          ///< robot
  RobotBack,             ///< robot; value: s between its last message and the next one
  SecondSender,          ///< robot; detail: the sender that is shown
  BatteryLow,            ///< robot; value: tenths of a volt
  AddressChanged,        ///< robot; detail: "10.0.0.3 to 10.0.0.7"
  ClockSet,              ///< the computer's clock was changed; value: by this many seconds
  Penalised,             ///< robot; detail: the reason; value: seconds left
  PenaltyOver,           ///< robot
  ProcessStarted,        ///< robot, process; value: its process id
  ProcessRestarted,      ///< the same for a process of this name that ran before
  ProcessEnded,          ///< robot, process; on request, or with exit code 0
  ProcessDied,           ///< robot, process; detail: how, and its last line of output
  ProcessNotResponding,  ///< robot, process; detail: how long ago the last sign of life was
  ProcessGivenUp,        ///< robot, process; it kept ending and is no longer restarted
  ProcessRealTime,       ///< robot, process; it does not follow the match's speed; detail: why
  ProcessNotAttached,    ///< robot, process; the match no longer waits for it; detail: waiting time
  CycleLate,       ///< robot; its program did not finish a cycle in time; detail: waiting time
  PortLost,        ///< value: the port; detail: why nothing can be received on it
  PortBack,        ///< value: the port
  PortsShared,     ///< detail: which program also receives, and who gets what; empty: none does
  SettingChanged,  ///< detail: what was changed by hand, such as "noise"
  RerunDiffers,    ///< robot, process; detail: the variable, and both values
  LetGo,           ///< robots stopped following a recording; detail: why
  Undone,          ///< everything that followed from `cause` was undone
  Bookmark,        ///< detail: the user's note
  Other,           ///< a kind that this version does not know; detail: its name in the file
  RuleBroken,      ///< robot; value: the severity, 0 to 2; detail: what the rule says, and the same
  Note             ///< drawn by the user; detail: its text, or what was drawn where
};
inline constexpr std::size_t matchEventKindCount = 49;

/// The half of the field that a team defends.
enum class Side : std::uint8_t { Left, Right };

struct MatchEvent {
  MatchEventKind kind = MatchEventKind::Other;
  double time = 0.0;
  RobotUid robot{};            ///< 0: no robot, or one that is no longer known
  std::string name{};          ///< the robot's name at that time, such as "B1"; empty: no robot
  std::optional<Side> side{};  ///< side of the team that scored
  int team = 0;                ///< the referee's number of that team; 0: none
  std::optional<TeamColor> colour{};  ///< of that team
  std::string teamName{};      ///< name of that team in a team setup or the scenario; may be empty
  std::optional<int> value{};  ///< see MatchEventKind
  std::optional<sim::Score> score{};
  std::optional<PlayState> state{};  ///< of GameState; empty: the clock is stopped
  std::string process{};             ///< "decision"
  std::string detail{};              ///< see MatchEventKind
  std::uint32_t cause = 0;  ///< number of the manual call or change that caused it; 0: none
  bool operator==(const MatchEvent&) const = default;
};

/// The mark on the timeline; events with None appear only in the list.
enum class EventShape : std::uint8_t {
  None,
  Goal,
  Kick,
  Fall,
  BallOut,
  BallLost,
  GameState,
  Died,
  Started,
  Offline,
  Back,
  Warning,
  Bookmark
};
inline constexpr std::size_t eventShapeCount = 13;

struct MatchEventInfo {
  MatchEventKind kind;
  std::string_view name;       ///< identifier in files and JSON; must never change
  std::string_view predicate;  ///< predicate of the sentence: what the robot, process or game did
  EventShape shape;
  int importance;           ///< where marks overlap, only the most important one is drawn
  bool labelled;            ///< the mark has a label if there is room
  bool warning;             ///< the log shows it as a warning
  std::string_view origin;  ///< origin in the log if no robot is concerned
};

const MatchEventInfo& info(MatchEventKind kind);
/// Finds a kind by MatchEventInfo::name; empty if there is none.
std::optional<MatchEventKind> matchEventKind(std::string_view name);
inline bool isMarked(const MatchEvent& event) {
  return info(event.kind).shape != EventShape::None;
}

std::string_view sideName(Side side);
std::optional<Side> sideNamed(std::string_view name);

/// Makes an event about this robot.
MatchEvent eventOf(MatchEventKind kind, double time, RobotUid robot, std::string name);
/// Returns the team that defends this side: that of the first robot that attacks the other side. If
/// there is none, blue defends the left and red the right.
TeamColor teamOn(Side side, std::span<const sim::RobotIdentity> robots);
/// Converts an event of the simulation. `state` is the world after the step in which it happened.
MatchEvent matchEvent(const sim::Event& event, const sim::WorldState& state);

/// Removes all Undone events and the events that they undo.
void dropUndone(std::vector<MatchEvent>& events);

/// Returns a line for a list: "B1 kicks the ball: kick left", "goal for BLUE, 1 : 0".
std::string sentenceOf(const MatchEvent& event);
/// Returns the text beside a mark, such as "goal BLUE"; empty for kinds without a label.
std::string labelOf(const MatchEvent& event);
/// Returns a line of the log, in which origin and text are separate.
LogLine logLineOf(const MatchEvent& event);

}  // namespace pitchboard::link
