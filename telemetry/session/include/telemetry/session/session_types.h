// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a session file contains besides rows: who wrote it, events, log lines, datagrams. Times are
// seconds of the source (simulated time, or seconds since Live began). Plain values; any thread.
// docs/file-formats.md describes the format.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <base/log_line.h>
#include <telemetry/series/series_types.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// Version of the format that this program writes. Files of later versions are read as far as
/// they are understood.
inline constexpr int sessionFormat = 1;

struct SessionInfo {
  std::string program;  ///< name and version
  std::string source;   ///< "simulation" or "live"
  std::string title;    ///< scenario, or what the user called it
  std::optional<std::uint64_t> seed;
  WallTime start{};    ///< wall time of second 0; timestamps in the file count from it
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
  Checkpoints,  ///< pieces of a simulated match that can be restored exactly
  LiveState     ///< state of a live match; later moments follow from the datagrams
};
inline constexpr std::size_t sessionStreamCount = 7;

/// What is known of an event besides time and kind, for programs. Empty or 0 if it does not apply.
struct EventFacts {
  RobotUid robot;            ///< 0 before 0.24: then only its name says which robot it is
  std::string side;          ///< "left" or "right"
  int team = 0;              ///< the team's number in the GameController
  std::string colour;        ///< the team's colour: "blue"
  std::string teamName;      ///< the team's name; may be empty
  std::optional<int> value;  ///< its meaning depends on the kind
  std::optional<std::pair<int, int>> score;  ///< left, right
  std::string process;                       ///< "decision"
  std::string detail;
  int cause = 0;  ///< number of the call by hand that caused it
  bool operator==(const EventFacts&) const = default;
};

/// Something that happened: a goal, a fall, a bookmark.
struct SessionEvent {
  double time = 0.0;
  std::string kind;   ///< "goal", "kick", ...: docs/sessions.md, "Events"
  std::string group;  ///< the robot's name, or empty
  std::string text;   ///< for people; programs read the facts
  /// Missing in sessions from before 0.2.
  std::optional<EventFacts> facts = {};
  bool operator==(const SessionEvent&) const = default;
};

/// A datagram as it arrived; the payload may be any bytes.
struct SessionDatagram {
  double time = 0.0;
  Sender sender;
  std::uint16_t localPort = 0;
  std::string payload;
  bool operator==(const SessionDatagram&) const = default;
};

}  // namespace pitchboard::telemetry
