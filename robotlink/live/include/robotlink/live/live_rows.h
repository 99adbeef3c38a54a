// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What live robots send as rows: a group for each robot, the profile's fields as columns, and how
// well the messages come (category "Link": AGE s, RATE 1/s, LOSS share, ERRORS count, VOLTS). One
// row for each message, with its own time; while a robot is silent one row a health report, so that
// its age is seen to grow. Times are seconds since `zero`.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/series/row_sink.h>
#include <telemetry/wire/team_monitor.h>

namespace pitchboard::telemetry {

/// Of the columns that say how well a robot is heard; the others are fields of its messages.
inline constexpr const char* linkCategory = "Link";

struct LiveRowsOptions {
  WallTime zero{};  ///< the moment that counts as 0 s
  /// Name of the group of a robot with this number; empty function: "Robot 3".
  std::function<std::string(int number)> name;
  /// Further attributes of its group; empty function: none.
  std::function<std::map<std::string, std::string>(int number)> attributes;
};

/// Not thread-safe: lives beside the TeamMonitor. A group's attributes: "number", "sender" (its
/// address), "live" = "1". Two senders with one number are two groups, the second one named
/// "Robot 3 (192.168.0.7)".
class LiveRows {
 public:
  explicit LiveRows(std::shared_ptr<RowSink> sink, LiveRowsOptions options = {});
  ~LiveRows();

  /// After TeamMonitor::take() said Used: one row.
  void take(const DatagramView& datagram, const DecodedText& decoded, const TextDecoder& decoder);
  /// From time to time (a few times a second): health for the coming rows, and rows for robots that
  /// have been silent since the last report. A robot that timed out gets one last row.
  void report(const TeamStatus& status);
  /// Forgets the robots (not the rows).
  void clear();

 private:
  struct Robot;
  Robot& robotOf(int number, const Sender& sender);
  void describe(Robot& robot, const TextDecoder& decoder, std::size_t values);
  void append(Robot& robot, WallTime time);

  std::shared_ptr<RowSink> m_sink;
  LiveRowsOptions m_options;
  std::vector<Robot> m_robots;
  Profile m_profile;  // of which the groups are
  std::uint64_t m_generation = 0;
};

}  // namespace pitchboard::telemetry
