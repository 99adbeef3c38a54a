// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rebuilds the blackboards that robots send with pitchboard-agent (docs/agent.md). Variables arrive
// one by one, late, twice or never; this makes rows of them with the times of our clock. Part of a
// LivePipeline, used on its thread.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/robot_uids.h>
#include <telemetry/monitor/link_health.h>
#include <telemetry/monitor/team_monitor.h>
#include <telemetry/pb2/pb2.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::link {

/// A catalog with a name, for robots that send variables beyond the published ones.
struct NamedCatalog {
  std::string name;  ///< "published", or the file's name
  VariableCatalog catalog;
};

/// How the variables of one robot arrive.
struct SentStatus {
  RobotUid uid;
  RobotKey robot;                    ///< the key in the frames
  std::string name;                  ///< robotName() of the key
  telemetry::LinkHealth link;        ///< its jitter is that of the latency
  std::size_t variables = 0;         ///< different variables received so far
  std::vector<std::string> unknown;  ///< names of variables that `catalog` does not contain
  std::string catalog;               ///< name of the catalog that contains most of the variables
  double clockOffset = 0.0;          ///< s, our clock minus the robot's
  std::uint64_t restarts = 0;        ///< of the agent
  std::optional<std::int64_t> refresh_ms, waiting;  ///< as the agent reports; empty: not reported
  bool blackboard = true;                           ///< false: the agent waits for a blackboard
  std::uint64_t refused = 0;                        ///< values beyond SentBoards::maxVariables
};

class SentBoards {
 public:
  static constexpr std::size_t maxVariables = 1000;  ///< per robot
  static constexpr std::size_t maxRobots = 64;

  /// `uids` may be shared with others that receive the same robots.
  explicit SentBoards(std::shared_ptr<RobotUids> uids = std::make_shared<RobotUids>());
  ~SentBoards();

  /// Sets the catalogs, of which there must be at least one. A robot's catalog is the one that
  /// contains most of its variables; the first of equals wins.
  void setCatalogs(std::vector<NamedCatalog> catalogs);
  /// Sets after which time without a message a robot is offline.
  void setTimeout(telemetry::Duration timeout) { m_timeout = timeout; }

  enum class Verdict : std::uint8_t {
    Used,
    Late,  ///< a newer message came first; only variables without a newer value were updated
    Duplicate,
    TooManyRobots
  };
  /// Takes a message that came to a port of variables at `arrival` (s). `place` is the
  /// RobotKey::team of robots whose datagrams arrive on that port.
  Verdict take(const telemetry::Pb2Message& message, const telemetry::DatagramView& datagram,
               int place, double arrival);

  /// Calls `take` with the rows since the last call, from the first value that a robot sends on.
  /// The name of a group is its GroupInfo::id and is not shown; it does not change with the robot's
  /// address, which is RobotFacts::sentFrom. Variables that come later become further
  /// columns, which are NaN in the rows before.
  void drainRows(const BoardRowsTaker& take);
  /// Returns the RobotKey::team of a robot with this number at this address.
  using Placing = std::function<std::optional<int>(int number, telemetry::Address sender)>;
  /// The teams have changed.
  void place(const Placing& placeOf);
  /// Returns the robots for joinBoards(): their team is the `place` of take(), their name that of
  /// their group, and they have no colour.
  std::vector<RobotFrame> robots(telemetry::WallTime now, const sim::FieldSpec& field,
                                 const telemetry::MonitorOptions& teams) const;
  /// Returns the states in the order of robots(), with empty keys and names.
  std::vector<SentStatus> status(telemetry::WallTime now) const;

  void forget(int number, telemetry::Address address);
  void clear();

 private:
  struct Robot;
  Robot* robotOf(int number, const telemetry::Sender& sender, int place, telemetry::WallTime time);
  void describe(Robot& robot) const;
  /// Makes the row of the newest sample; more of it may come, and its row is made again.
  void append(Robot& robot) const;
  const NamedCatalog& catalogOf(Robot& robot) const;
  telemetry::LinkHealth linkOf(const Robot& robot, telemetry::WallTime now) const;

  std::vector<NamedCatalog> m_catalogs;
  telemetry::Duration m_timeout = std::chrono::seconds(10);
  std::shared_ptr<RobotUids> m_uids;
  std::vector<std::unique_ptr<Robot>> m_robots;
};

}  // namespace pitchboard::link
