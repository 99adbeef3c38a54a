// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Gives each live robot its RobotUid at its first datagram. Messages and variables of one robot
// have the same one, in whatever order they come. Names, colours and teams play no part, so that a
// referee or an operator who corrects them mixes up no robots. This is the only place that follows
// a robot from key to key. A plain value, not thread-safe. Memory is bounded: of robots with
// unusual numbers, the one that was received longest ago leaves.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/drawings/drawing_store.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::link {

class RobotUids {
 public:
  /// More than the robots with slots of their own (hasOwnPlace()) of all teams.
  static constexpr std::size_t maxRobots = 2048;

  /// Returns the robot that sends messages under this key. `key` is as TeamMonitor::used().
  RobotUid ofMessages(const RobotKey& key, telemetry::Address sender);
  /// Returns the robot that begins to send variables from this address. `place` is its
  /// RobotKey::team, if it is known. `isReceived` says which robots send variables at the moment:
  /// one of the same number and team that sends nothing any more has changed its address.
  RobotUid ofVariables(int number, telemetry::Address sender, int place,
                       const std::function<bool(RobotUid)>& isReceived);
  /// The robot sends its variables from another address now.
  void move(RobotUid robot, telemetry::Address sender);

  /// The keys of robots have changed: TeamMonitor::renamings().
  void rename(const std::vector<telemetry::Renaming>& renamings);
  /// All other keys may mean other robots from now on.
  void keepOnly(const std::vector<RobotKey>& keys);
  /// Returns the key under which this robot sends messages; nothing if it sends none.
  std::optional<RobotKey> keyOf(RobotUid robot) const;
  /// Returns the robot that sends messages under this key; uidOf() if there is none.
  RobotUid withKey(const RobotKey& key) const;

  struct Known {
    RobotUid uid;
    int number = 0, place = 0;
    telemetry::Address sender;
    std::optional<RobotKey> key;  ///< of its messages
    bool sendsVariables = false;
  };
  RobotUids() = default;
  /// Continues from known().
  explicit RobotUids(std::vector<Known> known) : m_known(std::move(known)) {}
  const std::vector<Known>& known() const { return m_known; }

 private:
  std::size_t find(const auto& fits) const {
    return static_cast<std::size_t>(std::ranges::find_if(m_known, fits) - m_known.begin());
  }
  Known& take(std::size_t index, int place, int number, telemetry::Address sender);

  std::vector<Known> m_known;  // received longest ago first
};

/// Returns the robot whose blackboard on this computer has this System V key.
RobotUid uidOfBoard(int boardKey);

/// What one robot's rows are about; each is a group.
enum class RobotRows { Messages, Link, Variables, Agent };
/// Returns GroupInfo::id of a group of this robot.
std::string groupId(RobotUid robot, RobotRows rows);
/// Returns a name that is not in `taken`, for a robot that was `name` before another one was; adds
/// it to `taken`.
std::string earlierName(std::string_view name, std::set<std::string>& taken);

}  // namespace pitchboard::link
