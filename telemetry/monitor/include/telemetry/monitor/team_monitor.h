// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All robots that send datagrams: which ones there are, what each sent last, and how good its link
// is. A robot is identified by its number in its team and keeps its key if its address changes;
// when teams are set up, it continues under a new key. Another program with the same number is a
// robot of its own while it sends other values. Times are arguments; no clock is read. Memory is
// bounded by the limits below, and what exceeds them is counted.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/drawings/drawing_store.h>
#include <telemetry/formats/text_decoder.h>
#include <telemetry/monitor/arrival_stats.h>
#include <telemetry/monitor/link_health.h>
#include <telemetry/monitor/process_filter.h>
#include <telemetry/monitor/sender_filter.h>
#include <telemetry/monitor/sequence_stats.h>
#include <telemetry/monitor/team_setup.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

struct MonitorOptions {
  /// Numbers 1 to 32 of each team always fit; higher ones and second senders share further slots.
  static constexpr int ordinaryRobots = 32;
  static constexpr std::size_t otherRobots = 32;
  static constexpr std::size_t maxRobots(std::size_t teams) {
    return std::max(teams, std::size_t{1}) * ordinaryRobots + otherRobots;
  }
  std::size_t maxRobots() const { return maxRobots(teams.size()); }
  Duration timeout = std::chrono::seconds(10);
  /// The same bytes from the same robot within this time are one message that was delivered twice;
  /// later they may come from a robot that stands still.
  Duration duplicateWindow = std::chrono::milliseconds(5);
  BatteryLimits battery;
  std::map<int, BatteryLimits> teamBatteries;  ///< of teams whose robots have others, by index
  SenderFilter senders;
  std::vector<TeamSetup> teams;  ///< empty: one team, with the profile
  Surroundings field;
  /// Returns the limits of the batteries of a team, by its index (RobotKey::team).
  const BatteryLimits& batteryOf(int team) const {
    const auto found = teamBatteries.find(team);
    return found == teamBatteries.end() ? battery : found->second;
  }
};

/// Returns whether this robot has a slot of its own: a number up to ordinaryRobots, and no second
/// sender.
constexpr bool hasOwnPlace(const RobotKey& robot) {
  return robot.sender == 0 && robot.number <= MonitorOptions::ordinaryRobots;
}

/// One robot at one moment. A value that may cross threads.
struct RobotStatus : LinkHealth {
  RobotKey key;
  std::array<ProcessHeartbeat, processCount> processes{};
  std::optional<Battery> battery;
  WallTime lastMessage{};
  ErrorTally errors;
  std::shared_ptr<const TextDecoder> decoder;  ///< names and types of the values
  std::vector<double> values;                  ///< in the order of the profile; NaN if missing
  std::vector<std::string> texts;              ///< as sent
  std::vector<std::string> extras;             ///< keys of the values after those of the profile

  /// Returns the last value with this meaning, in the unit of the profile (cm, degrees, ...).
  std::optional<double> value(FieldMeaning meaning) const;
  /// Returns the name of one of the values, as TextDecoder::name().
  std::string name(std::size_t index) const;
};

/// An address that sends, whether or not its messages can be used.
struct SenderStatus {
  Address address;
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  ErrorTally errors;
};

struct TeamStatus {
  WallTime time{};
  std::vector<RobotStatus> robots;    ///< by key
  std::vector<SenderStatus> senders;  ///< the first 64 addresses
  std::uint64_t datagrams = 0;
  std::uint64_t refusedByFilter = 0;  ///< datagrams from senders that are not allowed
  std::uint64_t refusedRobots = 0;    ///< messages of robots beyond MonitorOptions::maxRobots()
  ErrorTally errors;                  ///< errors of all senders together
};

/// Not thread-safe: it belongs to the thread that receives, and returns values.
class TeamMonitor {
 public:
  explicit TeamMonitor(Profile profile = publishedProfile(), MonitorOptions options = {});
  ~TeamMonitor();
  TeamMonitor(TeamMonitor&&) noexcept;
  TeamMonitor& operator=(TeamMonitor&&) noexcept;

  enum class Verdict : std::uint8_t {
    Used,     ///< the robot's values were updated (single fields may have errors)
    Refused,  ///< not usable; the errors say why
    Duplicate,
    Late,           ///< older than an earlier one; no value is changed
    SenderRefused,  ///< the sender is not allowed
    TooManyRobots
  };

  /// Returns the robot whose message was used last.
  const RobotKey& used() const { return m_used; }

  /// Takes a datagram. decoded() then holds its values until the next call.
  Verdict take(const DatagramView& datagram);
  const DecodedText& decoded() const { return m_decoded; }
  /// Returns TeamRouter::placeOf(), or nothing if the sender is not allowed.
  std::optional<int> placeOf(const DatagramView& datagram, std::optional<int> team) const;
  /// Returns the RobotKey::team of a robot with this number that sends other than messages from
  /// this address. Of the teams that allow the sender it is one whose robot sends messages from
  /// there (unless programs of this computer share the address), then `ours`, then the first.
  /// Nothing if the sender is not allowed.
  std::optional<int> teamOf(Address sender, int number, int ours) const;

  /// Changes the profile for the next messages; link health and counters are kept.
  void setProfile(Profile profile);
  /// Robots of setups that remain keep their team. The others have no team until a message assigns
  /// them to one, and are forgotten if they go offline before.
  void setOptions(MonitorOptions options);
  /// Returns the robots whose keys the last take(), setOptions() or forget() has changed.
  const std::vector<Renaming>& renamings() const { return m_renamings; }
  const TextDecoder& decoder() const { return *m_decoder; }
  const MonitorOptions& options() const { return m_options; }

  /// Returns everything that is known at `now`.
  TeamStatus status(WallTime now) const;
  /// Forgets a robot. Another program that uses its number takes its place.
  void forget(const RobotKey& key);
  /// Forgets robots, senders and counters.
  void clear();

  /// Returns the state of the robots as JSON, with times relative to `zero`; restore() reads it.
  /// Senders and overall counters are left out.
  std::string robotsText(WallTime zero) const;
  /// Continues from such a state. Profile and options are not part of it. Fails with ParseError,
  /// and then nothing has changed.
  Result<void> restoreRobots(std::string_view json, WallTime zero);

 private:
  struct Robot;
  struct SenderRecord;
  friend struct MonitorSnapshot;  // writes and reads all of it
  Robot* findRobot(int team, int number, const Sender& sender, WallTime time);
  Robot* newRobot(int team, int number, WallTime time);
  RobotKey freeKey(int team, int number) const;
  void foldAway(WallTime time);
  bool isGone(const Robot& robot, WallTime time) const;
  bool sendsTheSame(const Robot& robot) const;
  bool isOverdue(const Robot& robot, WallTime time) const;
  void giveBack(Robot& robot, const Sender& sender, WallTime time);
  SenderRecord* findSender(Address address);
  RobotStatus statusOf(const Robot& robot, WallTime now) const;
  void arrive(Robot& robot, WallTime time);
  void use(Robot& robot, const DatagramView& datagram);

  void makeRouter();

  MonitorOptions m_options;
  Profile m_profile;
  std::unique_ptr<const TeamRouter> m_router;
  std::shared_ptr<const TextDecoder> m_decoder;
  DecodedText m_decoded;
  std::vector<Robot> m_robots;
  std::vector<SenderRecord> m_senders;
  std::vector<Renaming> m_renamings;
  RobotKey m_used;
  std::uint64_t m_datagrams = 0, m_refusedByFilter = 0, m_refusedRobots = 0;
  ErrorTally m_errors;
};

}  // namespace pitchboard::telemetry
