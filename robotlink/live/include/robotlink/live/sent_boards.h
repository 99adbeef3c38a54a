// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Blackboards that robots send (pitchboard-agent, docs/agent.md): variables come one by one, late,
// twice or not at all; here they become samples again, with our times. Part of a LivePipeline, on
// its thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/live/attached_robots.h>
#include <telemetry/pb2/pb2.h>
#include <telemetry/wire/datagram.h>
#include <telemetry/wire/link_health.h>

namespace pitchboard::link {

/// A map of variables by its name, for robots that send more than the published one has.
struct NamedCatalog {
  std::string name;  ///< "published", or the file's name
  VariableCatalog catalog;
};

/// How the variables of one robot arrive.
struct SentStatus {
  RobotKey robot;                    ///< as in the frames
  std::string name;                  ///< robotName() of the key
  telemetry::LinkHealth link;        ///< its jitter is that of the delay
  std::size_t variables = 0;         ///< received so far
  std::vector<std::string> unknown;  ///< those that `catalog` does not have, by name
  std::string catalog;               ///< NamedCatalog::name of the one that has the most of them
  double clockOffset = 0.0;          ///< s, our clock minus the robot's
  std::uint64_t restarts = 0;        ///< of the sending program
  std::optional<std::int64_t> refresh_ms, waiting;  ///< as it says itself; nothing: it does not
  bool blackboard = true;                           ///< false: it waits for one
  std::uint64_t refused = 0;                        ///< values beyond SentBoards::maxVariables
};

class SentBoards {
 public:
  static constexpr std::size_t maxVariables = 1000;  ///< of a robot
  static constexpr std::size_t maxRobots = 64;

  SentBoards();
  ~SentBoards();

  /// To recognize variables by: the first one that has the most names of a robot. Not empty.
  void setCatalogs(std::vector<NamedCatalog> catalogs);
  /// Robots that send nothing for this time are offline.
  void setTimeout(telemetry::Duration timeout) { m_timeout = timeout; }

  enum class Verdict : std::uint8_t {
    Used,
    Late,  ///< a newer one came before: only variables of which nothing newer is known change
    Duplicate,
    TooManyRobots
  };
  /// A message that came to a port of variables at `arrival` (s). `place`: RobotKey::team of robots
  /// whose datagrams come like this one.
  Verdict take(const telemetry::Pb2Message& message, const telemetry::DatagramView& datagram,
               int place, double arrival);

  /// Calls `take` with the rows since the last call. The name of their group is not for people; it
  /// stays the same whatever address the robot has, which is "sent". Rows begin once every variable
  /// that is sent was received.
  void takeRows(const BoardRowsTaker& take);
  /// The robots, for joinBoards(): with the place as team, the name of their group, and without a
  /// colour. `now`: of arrival.
  std::vector<RobotFrame> robots(telemetry::WallTime now, const sim::FieldSpec& field) const;
  /// In the same order as robots(), without keys and names.
  std::vector<SentStatus> status(telemetry::WallTime now) const;

  void forget(int number, telemetry::Address address);
  void clear();

 private:
  struct Robot;
  Robot* robotOf(int number, const telemetry::Sender& sender, telemetry::WallTime time);
  void describe(Robot& robot) const;
  void append(Robot& robot, double time) const;
  const NamedCatalog& catalogOf(const Robot& robot) const;
  telemetry::LinkHealth linkOf(const Robot& robot, telemetry::WallTime now) const;

  std::vector<NamedCatalog> m_catalogs;
  telemetry::Duration m_timeout = std::chrono::seconds(10);
  std::vector<std::unique_ptr<Robot>> m_robots;
  std::uint64_t m_made = 0;  // robots, ever
};

}  // namespace pitchboard::link
