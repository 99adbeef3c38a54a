// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What stands in a session file besides rows: who wrote it, events, datagrams. Times are
// seconds of the source (simulated time, or seconds since Live began). Plain values.
// The format is told in docs/sessions.md.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <base/log_line.h>
#include <telemetry/series/series_types.h>
#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// Version of the format that this program writes. Higher ones are read as far as known.
inline constexpr int sessionFormat = 1;

struct SessionInfo {
  std::string program;  ///< name and version
  std::string source;   ///< "simulation" or "live"
  std::string title;    ///< scenario, or what the user called it
  std::optional<std::uint64_t> seed;
  WallTime start{};    ///< wall time at which the source was at 0 s; the files' times count on it
  WallTime created{};  ///< when recording began
  std::map<std::string, std::string> more;
  bool operator==(const SessionInfo&) const = default;
};

/// Streams of JSON messages.
enum class SessionStream : std::uint8_t {
  Events,       ///< SessionEvent
  Log,          ///< LogLine
  Telemetry,    ///< SessionDatagram from a robot
  RefereeRaw,   ///< SessionDatagram of the referee
  Referee,      ///< a referee packet decoded
  Checkpoints,  ///< pieces of a simulated match that can be re-entered exactly
  LiveState     ///< what was known of a live match; what came later follows from the datagrams
};
inline constexpr std::size_t sessionStreamCount = 7;

/// What is known of an event besides its time and kind, for programs. Empty or 0: does not apply.
struct EventFacts {
  int robot = 0;                             ///< number on its shirt; until 0.8: of its blackboard
  std::optional<int> robotTeam;              ///< its RobotKey::team; nothing until 0.8
  int sender = 0;                            ///< its RobotKey::sender
  std::string side;                          ///< "left" or "right"
  int team = 0;                              ///< the referee's number
  std::string colour;                        ///< of the team: "blue"
  std::optional<int> value;                  ///< what it counts depends on the kind
  std::optional<std::pair<int, int>> score;  ///< left, right
  std::string process;                       ///< "decision"
  std::string detail;
  int cause = 0;  ///< the decision by hand that it follows from
  bool operator==(const EventFacts&) const = default;
};

/// Something that happened: a goal, a fall, a bookmark.
struct SessionEvent {
  double time = 0.0;
  std::string kind;   ///< "goal", "kick", ...: docs/sessions.md
  std::string group;  ///< the robot's name, or empty
  std::string text;   ///< for people; programs read the facts
  /// Nothing in sessions before 0.2.
  std::optional<EventFacts> facts = {};
  bool operator==(const SessionEvent&) const = default;
};

/// A datagram as it arrived, any bytes.
struct SessionDatagram {
  double time = 0.0;
  Sender sender;
  std::uint16_t localPort = 0;
  std::string payload;
  bool operator==(const SessionDatagram&) const = default;
};

}  // namespace pitchboard::telemetry
