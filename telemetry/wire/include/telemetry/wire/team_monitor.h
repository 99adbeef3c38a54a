// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One team as its datagrams show it: who is there, what each one last said, and how well. A robot
// is its number in its team and keeps its key, whatever address it sends from; when other teams are
// set up, it goes on under the key that it then has. Another program that uses its number is a
// robot of its own when it says something else, until it falls silent. Time is handed in, so that
// ten seconds of silence are tested in no time. Memory is bounded by the limits below; what they
// refuse is counted.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/wire/arrival_stats.h>
#include <telemetry/wire/datagram.h>
#include <telemetry/wire/link_health.h>
#include <telemetry/wire/process_filter.h>
#include <telemetry/wire/sender_filter.h>
#include <telemetry/wire/sequence_stats.h>
#include <telemetry/wire/team_setup.h>
#include <telemetry/wire/text_decoder.h>

namespace pitchboard::telemetry {

struct MonitorOptions {
  /// Numbers 1 to 32 of each team always find room; all higher ones and second senders share the
  /// other places.
  static constexpr int ordinaryRobots = 32;
  static constexpr std::size_t otherRobots = 32;
  static constexpr std::size_t mostRobots(std::size_t teams) {
    return std::max(teams, std::size_t{1}) * ordinaryRobots + otherRobots;
  }
  std::size_t mostRobots() const { return mostRobots(teams.size()); }
  Duration timeout = std::chrono::seconds(10);
  /// The same bytes from the same robot within this time are one message delivered twice. (Later
  /// they may well be a robot that stands still.)
  Duration duplicateWindow = std::chrono::milliseconds(5);
  BatteryLimits battery;
  SenderFilter senders;
  std::vector<TeamSetup> teams;  ///< empty: one team, of the profile
  Surroundings field;
};

/// This robot need not share its place.
constexpr bool hasOwnPlace(const RobotKey& robot) {
  return robot.sender == 0 && robot.number <= MonitorOptions::ordinaryRobots;
}

/// One robot at one moment: a value that may cross threads.
struct RobotStatus : LinkHealth {
  RobotKey key;
  std::array<ProcessHeartbeat, processCount> processes{};
  std::optional<Battery> battery;
  WallTime lastMessage{};
  ErrorTally errors;
  std::shared_ptr<const TextDecoder> decoder;  ///< names and types of the values
  std::vector<double> values;                  ///< NaN where missing; place as in the profile
  std::vector<std::string> words;              ///< as sent
  std::vector<std::string> extras;             ///< keys of the values behind the profile's

  /// The last value with this meaning, in the message's unit (cm, degrees, ...).
  std::optional<double> value(FieldMeaning meaning) const;
  /// TextDecoder::name() of one of the values.
  std::string name(std::size_t index) const;
};

/// One address that sends, whether or not its messages can be used.
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
  std::uint64_t refusedByFilter = 0;  ///< from senders that are not on the list
  std::uint64_t refusedRobots = 0;    ///< of robots beyond MonitorOptions::mostRobots()
  ErrorTally errors;                  ///< of everybody together
};

/// Not thread-safe; lives in the thread that takes the datagrams, hands out values.
class TeamMonitor {
 public:
  explicit TeamMonitor(Profile profile = publishedProfile(), MonitorOptions options = {});
  ~TeamMonitor();
  TeamMonitor(TeamMonitor&&) noexcept;
  TeamMonitor& operator=(TeamMonitor&&) noexcept;

  enum class Verdict : std::uint8_t {
    Used,     ///< the robot's values are new (single fields may have errors)
    Refused,  ///< errors say why
    Duplicate,
    Late,           ///< a newer one came before it: no value is changed
    SenderRefused,  ///< not on the list
    TooManyRobots
  };

  /// The robot whose message was used last.
  const RobotKey& used() const { return m_used; }

  /// Takes one datagram. `decoded()` then holds its values until the next call.
  Verdict take(const DatagramView& datagram);
  const DecodedText& decoded() const { return m_decoded; }
  /// TeamRouter::placeOf(); nothing for senders that are not on the list.
  std::optional<int> placeOf(const DatagramView& datagram, std::optional<int> team) const;
  std::optional<int> placeOf(Address sender) const;

  /// From now on messages are read in this order; health and counters stay.
  void setProfile(Profile profile);
  /// Robots of setups that are still there stay theirs. The others have no team until they are
  /// heard as somebody's; those that fall silent before are forgotten.
  void setOptions(MonitorOptions options);
  /// Robots whose keys the last take() or setOptions() has changed.
  const std::vector<Renaming>& renamings() const { return m_renamings; }
  const TextDecoder& decoder() const { return *m_decoder; }
  const MonitorOptions& options() const { return m_options; }

  /// Everything known at `now`.
  TeamStatus status(WallTime now) const;
  /// Forgets one robot, so that its key is free; another program that uses the number moves up.
  void forget(const RobotKey& key);
  /// Forgets robots, senders and counters.
  void clear();

  /// All that later statuses of the robots follow from, as JSON; times count from `zero`. Senders
  /// and the counters of everybody together are left out.
  std::string robotsText(WallTime zero) const;
  /// Goes on from there: from now on it says of the robots what the other one would say. The
  /// profile and the options are not part of it. Error ParseError; nothing has changed then.
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
  bool saysTheSame(const Robot& robot) const;
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
