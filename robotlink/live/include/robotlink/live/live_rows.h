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
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <robotlink/frame/teams.h>
#include <robotlink/live/robot_uids.h>
#include <telemetry/monitor/team_monitor.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

/// The category of the columns about a robot's link.
inline constexpr const char* linkCategory = "Link";

struct LiveRowsOptions {
  telemetry::WallTime zero{};  ///< the moment that counts as 0 s
  Teams teams;                 ///< used for the names of groups
  /// Adds what the options say of a robot (profile and names); may be empty.
  std::function<void(const RobotKey&, telemetry::RobotFacts&)> describe;
  /// Robots whose blackboards are received as well, with the names of those groups.
  std::map<RobotUid, std::string> boards{};
};

/// Not thread-safe: used together with the TeamMonitor. A group belongs to one robot for the whole
/// session (GroupInfo::id); its name and facts are what is known of the robot now. Another program
/// that uses the number at the same time is "Robot 3 (2)". The messages of a robot whose blackboard
/// is received, too, are "Robot 3 telemetry": its variables are "Robot 3". If a robot that is not
/// received any more had a name that another robot has now, it is "Robot 3 (earlier)".
class LiveRows {
 public:
  static constexpr std::size_t maxColumns = 200;  ///< per robot, over all its profiles
  /// Values of a message beyond its profile.
  static constexpr std::size_t maxExtras = telemetry::DecodedText::maxExtras;
  static constexpr std::size_t maxTexts = 64;  ///< different texts; all others are "other"

  /// Counts what exceeded the limits since the beginning.
  struct Refused {
    std::uint64_t rows = 0;    ///< rows of robots beyond MonitorOptions::maxRobots()
    std::uint64_t values = 0;  ///< values of fields beyond the limits
  };

  /// `uids` may be shared with others that receive the same robots.
  explicit LiveRows(std::shared_ptr<telemetry::RowSink> sink, LiveRowsOptions options = {},
                    std::shared_ptr<RobotUids> uids = std::make_shared<RobotUids>());
  ~LiveRows();

  /// Changes names and facts; `zero` is unchanged. If robots have got other keys, RobotUids
  /// knows it already. All groups change at once.
  void setOptions(LiveRowsOptions options);
  /// Adds a row after TeamMonitor::take() returned Used. `robot` is TeamMonitor::used().
  void take(const telemetry::DatagramView& datagram, const telemetry::DecodedText& decoded,
            const telemetry::TextDecoder& decoder, const RobotKey& robot);
  /// Adds the due rows of link groups. Call it a few times a second.
  void report(const telemetry::TeamStatus& status);
  const Refused& refused() const { return m_refused; }
  void clearRefused() { m_refused = {}; }

 private:
  struct Robot;
  Robot* robotOf(const RobotKey& key, const telemetry::Sender& sender);
  telemetry::GroupInfo groupOf(const Robot& robot) const;
  telemetry::GroupInfo linkOf(const Robot& robot) const;
  void nameRobots();
  static std::size_t placeOf(Robot& robot, telemetry::ColumnInfo column, bool& changed);
  static bool describe(Robot& robot, const telemetry::Profile& profile);
  void addGroups(Robot& robot);
  double timeOf(telemetry::WallTime time) const {
    return telemetry::secondsOf(time - m_options.zero);
  }

  std::shared_ptr<telemetry::RowSink> m_sink;
  LiveRowsOptions m_options;
  std::shared_ptr<RobotUids> m_uids;
  std::vector<Robot> m_robots;
  Refused m_refused;
};

}  // namespace pitchboard::link
