// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes rows of what live robots send. Each robot has two groups. "Robot 3" has a row per used
// message, with the message's time and the fields of the profile as columns. "Robot 3 link" has a
// row about once a second with the state of its link (AGE s, RATE 1/s, JITTER ms, LOSS share, LOST,
// DUPLICATES, LATE, ERRORS counts, VOLTS V, CHARGE %), until it has timed out. A value that means
// "not seen" (ProfileField::absent) is NaN. A text is a column of codes whose labels are the
// received texts (ColumnKind::Text). Unknown keys, longer messages and edited profiles add columns
// at the end. Times are seconds since `zero`. Memory is bounded by the limits below. Use it
// on the thread of the TeamMonitor.

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

/// The category of the columns about a robot's link.
inline constexpr const char* linkCategory = "Link";

struct LiveRowsOptions {
  WallTime zero{};    ///< the moment that counts as 0 s
  link::Teams teams;  ///< used for the names of groups
  /// Returns further attributes of a group; may be empty.
  std::function<std::map<std::string, std::string>(const RobotKey&)> attributes;
  /// Robots whose blackboards are received as well, with the names of those groups.
  std::map<RobotKey, std::string> boards{};
};

/// Not thread-safe: used together with the TeamMonitor. Attributes of a robot's group: "number",
/// "sender" (its address), "live" = "1", "team" = its colour where that is known; of its link
/// group: "link" = name of the robot. Another program that uses the number at the same time is
/// "Robot 3 (2)". The messages of a robot whose blackboard is received, too, are "Robot 3
/// telemetry": its variables are "Robot 3".
class LiveRows {
 public:
  static constexpr std::size_t maxColumns = 200;  ///< per robot, over all its profiles
  /// Values of a message beyond its profile.
  static constexpr std::size_t maxExtras = DecodedText::maxExtras;
  static constexpr std::size_t maxTexts = 64;  ///< different texts; all others are "other"

  /// Counts what exceeded the limits since the beginning.
  struct Refused {
    std::uint64_t rows = 0;    ///< rows of robots beyond MonitorOptions::mostRobots()
    std::uint64_t values = 0;  ///< values of fields beyond the limits
  };

  explicit LiveRows(std::shared_ptr<RowSink> sink, LiveRowsOptions options = {});
  ~LiveRows();

  /// Changes names and attributes, after robots have got other keys; `zero` is unchanged. Groups
  /// continue under their new names.
  void setOptions(LiveRowsOptions options, const std::vector<Renaming>& renamings);
  /// Adds a row after TeamMonitor::take() returned Used. `robot` is TeamMonitor::used().
  void take(const DatagramView& datagram, const DecodedText& decoded, const TextDecoder& decoder,
            const RobotKey& robot);
  /// Adds the due rows of link groups. Call it a few times a second.
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
