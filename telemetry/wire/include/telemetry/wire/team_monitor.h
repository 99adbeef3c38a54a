// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The whole team as its datagrams show it: who is there, what each one last said, and how well.
// Time is handed in, so that ten seconds of silence are tested in no time.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <telemetry/wire/arrival_stats.h>
#include <telemetry/wire/datagram.h>
#include <telemetry/wire/process_filter.h>
#include <telemetry/wire/sender_filter.h>
#include <telemetry/wire/text_decoder.h>

namespace pitchboard::telemetry {

/// When a battery is low. Volts of one cell (lithium polymer).
struct BatteryLimits {
  int cells = 0;  ///< cells in series; 0: the least that explain the highest voltage seen
  double fullPerCell = 4.2;
  double lowPerCell = 3.5;
  double emptyPerCell = 3.3;
};

struct Battery {
  double volts = 0.0;
  int cells = 0;
  double fraction = 0.0;  ///< 0 empty, 1 full, linear in the voltage
  bool low = false;
};

struct MonitorOptions {
  static constexpr std::size_t maxRobots = 64;
  Duration timeout = std::chrono::seconds(10);
  /// The same bytes from the same robot within this time are one message delivered twice. (Later
  /// they may well be a robot that stands still.)
  Duration duplicateWindow = std::chrono::milliseconds(5);
  BatteryLimits battery;
  SenderFilter senders;
};

enum class ProcessState : std::uint8_t { Unknown, Working, Silent };

/// Control, vision, localization, decision, IMU: the order of the message.
inline constexpr std::size_t processCount = 5;
inline constexpr std::array<std::string_view, processCount> processNames{
    "Control", "Vision", "Localization", "Decision", "IMU"};

struct ProcessStatus {
  ProcessState state = ProcessState::Unknown;  ///< Unknown: not in the message, or robot timed out
  double probability = 0.5;
  Duration since{};  ///< how long it has been in this state
};

/// One robot at one moment: a value that may cross threads.
struct RobotStatus {
  int number = 0;
  std::uint64_t serial =
      0;  ///< of this robot as long as it is remembered, whatever port it sends from
  Sender sender;
  bool conflict = false;  ///< another sender uses the same number at the moment
  bool timedOut = false;
  Duration age{};  ///< since the last usable message
  WallTime lastMessage{};
  std::uint64_t messages = 0;  ///< usable ones
  std::uint64_t bytes = 0;     ///< of all, payload only
  std::uint64_t timeouts = 0;  ///< times it came back
  double rate = 0.0;           ///< messages per second
  double jitter = 0.0;         ///< seconds
  std::optional<double> loss;  ///< 0 to 1, where the profile has a sequence number
  std::uint64_t lost = 0;
  ErrorTally errors;
  std::array<ProcessStatus, processCount> processes{};
  std::optional<Battery> battery;
  std::shared_ptr<const TextDecoder> decoder;  ///< names and types of the values
  std::vector<double> values;                  ///< NaN where missing; place as in the profile
  std::vector<std::string> words;              ///< as sent

  /// The last value with this meaning, in the message's unit (cm, degrees, ...).
  std::optional<double> value(FieldMeaning meaning) const;
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
  std::vector<RobotStatus> robots;    ///< by number, then sender
  std::vector<SenderStatus> senders;  ///< the first 64 addresses
  std::uint64_t datagrams = 0;
  std::uint64_t refusedByFilter = 0;  ///< from senders that are not on the list
  std::uint64_t refusedRobots = 0;    ///< of robots beyond the 64th
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
    SenderRefused,  ///< not on the list
    TooManyRobots
  };

  /// Serial of the robot whose message was used last.
  std::uint64_t usedSerial() const { return m_usedSerial; }

  /// Takes one datagram. `decoded()` then holds its values until the next call.
  Verdict take(const DatagramView& datagram);
  const DecodedText& decoded() const { return m_decoded; }

  /// From now on messages are read in this order; health and counters stay.
  void setProfile(Profile profile);
  void setOptions(MonitorOptions options);
  const TextDecoder& decoder() const { return *m_decoder; }
  const MonitorOptions& options() const { return m_options; }

  /// Everything known at `now`.
  TeamStatus status(WallTime now) const;
  /// Forgets robots, senders and counters.
  void clear();

 private:
  struct Robot;
  struct SenderRecord;
  Robot* findRobot(int number, const Sender& sender, WallTime time);
  SenderRecord* findSender(Address address);
  RobotStatus statusOf(const Robot& robot, WallTime now) const;
  void use(Robot& robot, const DatagramView& datagram);

  MonitorOptions m_options;
  std::shared_ptr<const TextDecoder> m_decoder;
  DecodedText m_decoded;
  std::vector<Robot> m_robots;
  std::vector<SenderRecord> m_senders;
  std::uint64_t m_serial = 0, m_usedSerial = 0;
  std::uint64_t m_datagrams = 0, m_refusedByFilter = 0, m_refusedRobots = 0;
  ErrorTally m_errors;
};

}  // namespace pitchboard::telemetry
