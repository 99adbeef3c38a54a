// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What live robots send as rows. Each robot has two groups: "Robot 3" has one row for each message
// that was used, with its own time and the profile's fields as columns, and nothing else; "Robot 3
// link" says about once a second how well it is heard (AGE s, RATE 1/s, JITTER ms, LOSS share,
// LOST, DUPLICATES, LATE, ERRORS counts, VOLTS V, CHARGE %), until it has timed out. A value that
// says "not seen" (ProfileField::absent) is a hole. A text is a column of codes whose labels are
// the words that came (ColumnKind::Text). Keys that the profile does not name, a longer message and
// an edited profile add columns behind the others. Times are seconds since `zero`. What is kept is
// bounded by the limits below.

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <robotlink/frame/teams.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/wire/team_monitor.h>

namespace pitchboard::telemetry {

/// Category of the columns that say how well a robot is heard.
inline constexpr const char* linkCategory = "Link";

struct LiveRowsOptions {
  WallTime zero{};    ///< the moment that counts as 0 s
  link::Teams teams;  ///< for the names of the groups
  /// Further attributes of its group; empty function: none.
  std::function<std::map<std::string, std::string>(const RobotKey&)> attributes;
  /// Robots whose blackboards are received, too, with the names of those rows.
  std::map<RobotKey, std::string> boards{};
};

/// Not thread-safe: lives beside the TeamMonitor. Attributes of a robot's group: "number", "sender"
/// (its address), "live" = "1", "team" = its colour where that is known; of its link group: "link"
/// = name of the robot. Another program that uses the number at the same time is "Robot 3 (2)". The
/// messages of a robot whose blackboard is received, too, are "Robot 3 telemetry": its variables
/// are "Robot 3".
class LiveRows {
 public:
  static constexpr std::size_t maxColumns = 200;  ///< of a robot, over all its profiles
  /// Values of a message beyond its profile.
  static constexpr std::size_t maxExtras = DecodedText::maxExtras;
  static constexpr std::size_t maxWords = 64;  ///< of a text; the rest is "other"

  /// What the limits kept out since the beginning.
  struct Refused {
    std::uint64_t rows = 0;    ///< of robots beyond MonitorOptions::mostRobots()
    std::uint64_t values = 0;  ///< in fields beyond the limits
  };

  explicit LiveRows(std::shared_ptr<RowSink> sink, LiveRowsOptions options = {});
  ~LiveRows();

  /// Names and attributes from now on, of robots that have other keys then; `zero` stays. Groups go
  /// on under their new names.
  void setOptions(LiveRowsOptions options, const std::vector<Renaming>& renamings);
  /// After TeamMonitor::take() said Used: one row. `robot`: TeamMonitor::used().
  void take(const DatagramView& datagram, const DecodedText& decoded, const TextDecoder& decoder,
            const RobotKey& robot);
  /// From time to time (a few times a second): rows of the link groups, where they are due.
  void report(const TeamStatus& status);
  const Refused& refused() const { return m_refused; }
  void clearRefused() { m_refused = {}; }

 private:
  struct Robot;
  Robot* robotOf(const RobotKey& key, const Sender& sender);
  GroupInfo groupOf(const Robot& robot) const;
  void renew(Robot& robot, std::string name);
  static std::size_t placeOf(Robot& robot, ColumnInfo column, bool& changed);
  static bool describe(Robot& robot, const Profile& profile);
  void addGroups(Robot& robot);
  double timeOf(WallTime time) const { return secondsOf(time - m_options.zero); }

  std::shared_ptr<RowSink> m_sink;
  LiveRowsOptions m_options;
  std::vector<Robot> m_robots;
  double m_newest = -std::numeric_limits<double>::infinity();  // time of a row
  Refused m_refused;
};

}  // namespace pitchboard::telemetry
