// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What happened in a match, simulated, live or recorded: one plain value, made once where it
// happens (SimulatedMatch, LiveWatch, the user) and carried as it is to timeline, log, session
// file, report and command line. Words are made from it here, and only to be shown: nobody reads
// them back. Times are seconds of the source.

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

enum class MatchEventKind : std::uint8_t {
  Goal,                ///< side, team, score
  ScoreCorrected,      ///< side, team, score
  BallOut,             ///<
  Kick,                ///< robot; value: the action
  Fall,                ///< robot
  GotUp,               ///< robot
  UnknownAction,       ///< robot; value: the code
  BallSeen,            ///< robot; after it was lost
  BallLost,            ///< robot; not seen for BallSight::lostAfter
  GameState,           ///< detail: "PLAYING"; value: seconds left, where there is a clock
  MatchOver,           ///< detail: the scenario's stop condition that is met
  Half,                ///< value: 1 or 2
  SetPlay,             ///< detail: "corner"; empty: normal play again
  GamePhase,           ///< detail: "penalty shoot-out"; empty: normal time
  PlayStopped,         ///< by the referee
  PlayGoesOn,          ///<
  RefereeReceived,     ///< for the first time, or another one; detail: who; value: its version
  RefereeOffline,      ///<
  RefereeBack,         ///<
  SecondReferee,       ///< detail: the one that is shown
  RobotReceived,       ///< robot; for the first time; detail: its sender
  RobotOffline,        ///< robot
  RobotBack,           ///< robot
  SecondSender,        ///< robot; detail: the sender that is shown
  BatteryLow,          ///< robot; value: tenths of a volt
  AddressChanged,      ///< robot; detail: "10.0.0.3 to 10.0.0.7"
  ClockSet,            ///< the computer's; value: by so many seconds
  Penalised,           ///< robot; detail: for what; value: seconds left
  PenaltyOver,         ///< robot
  ProcessStarted,      ///< robot, process; value: its process number
  ProcessRestarted,    ///< the same, when one of this name ran before
  ProcessEnded,        ///< robot, process; as it should: it was asked to, or exit code 0
  ProcessDied,         ///< robot, process; detail: how, and its last words
  ProcessSilent,       ///< robot, process; detail: for how long there was no sign of life
  ProcessGivenUp,      ///< robot, process; it ends again and again and is not started any more
  ProcessRealTime,     ///< robot, process; it does not follow the match's speed; detail: why
  ProcessNotAttached,  ///< robot, process; the match does not wait for it; detail: how long it has
  CycleLate,           ///< robot; its program did not finish a cycle in time; detail: for how long
  PortLost,            ///< value: the port; detail: why it cannot be received
  PortBack,            ///< value: the port
  Undone,              ///< what `cause` had led to before, all of it, was taken back
  Bookmark,            ///< detail: the user's note
  Other                ///< detail: what a later version, or a file of another one, calls it
};
inline constexpr std::size_t matchEventKindCount = 43;

/// Half of the field that a team defends.
enum class Side : std::uint8_t { Left, Right };

struct MatchEvent {
  MatchEventKind kind = MatchEventKind::Other;
  double time = 0.0;
  RobotKey robot{};            ///< number 0: none, or not known any more
  std::string name{};          ///< of the robot at that time, "B1"; empty: no robot
  std::optional<Side> side{};  ///< of the team that scored
  int team = 0;                ///< the referee's number of that team; 0: none
  std::string colour{};        ///< of that team: "blue"; empty or "unknown": not known
  std::optional<int> value{};  ///< see MatchEventKind
  std::optional<sim::Score> score{};
  std::string process{};    ///< "decision"
  std::string detail{};     ///< see MatchEventKind
  std::uint32_t cause = 0;  ///< the decision by hand that it follows from; 0: none
  bool operator==(const MatchEvent&) const = default;
};

/// How a timeline marks it; None: it is in the list, and marks would hide more than they say.
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
  Silent,
  Back,
  Warning,
  Bookmark
};
inline constexpr std::size_t eventShapeCount = 13;

struct MatchEventInfo {
  MatchEventKind kind;
  std::string_view name;   ///< in files and JSON: never change it
  std::string_view words;  ///< what is said of its robot, process or the game
  EventShape shape;
  int importance;           ///< the mark that stays where several would overlap: the highest
  bool labelled;            ///< its label stands beside the mark when there is room
  bool warning;             ///< in the log
  std::string_view origin;  ///< who says it in the log when it is no robot
};

const MatchEventInfo& info(MatchEventKind kind);
/// By MatchEventInfo::name; nothing for a name that nobody knows.
std::optional<MatchEventKind> matchEventKind(std::string_view name);
inline bool isMarked(const MatchEvent& event) {
  return info(event.kind).shape != EventShape::None;
}

std::string_view sideName(Side side);
std::optional<Side> sideNamed(std::string_view name);

/// An event of this robot.
MatchEvent eventOf(MatchEventKind kind, double time, const RobotKey& robot, std::string name);
/// The team that defends this side: that of the first robot that faces away from it; without one
/// blue on the left and red on the right.
TeamColor teamOn(Side side, std::span<const sim::RobotIdentity> robots);
/// An event of the simulation. `state`: right after the step in which it happened.
MatchEvent matchEvent(const sim::Event& event, const sim::WorldState& state);

/// Removes what an Undone event behind it takes back, and these events themselves.
void dropUndone(std::vector<MatchEvent>& events);

/// "B1 kicks the ball: kick left", "goal for BLUE, 1 : 0": a line of a list.
std::string sentenceOf(const MatchEvent& event);
/// "goal BLUE", "PLAYING": what stands beside a mark. Empty for kinds without a label.
std::string labelOf(const MatchEvent& event);
/// As a line of the log: who and what apart.
LogLine logLineOf(const MatchEvent& event);

}  // namespace pitchboard::link
