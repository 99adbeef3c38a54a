// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known about the robot, or the match, of a group of rows. Plain values; any thread.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/robot_key.h>
#include <base/team_color.h>

namespace pitchboard::telemetry {

/// A battery's voltages, in V.
struct BatteryVolts {
  double full = 0.0, low = 0.0, empty = 0.0;
  bool operator==(const BatteryVolts&) const = default;
};

/// Facts about a robot, and about how its rows came; all but `uid` can change at any time. What is
/// empty, 0 or false is unknown or does not apply.
struct RobotFacts {
  RobotUid uid;
  int slot = 0;    ///< number of its blackboard; of a simulated robot its RobotId
  int number = 0;  ///< on the shirt
  std::optional<TeamColor> team;
  std::optional<RobotOrder> order;  ///< where it stands in lists
  std::optional<int> place;         ///< RobotKey::team of a robot that sends its blackboard
  std::string name;                 ///< the name that its team gives it
  std::string teamName, profile, behaviour;
  std::vector<std::string> programs;  ///< files of the team programs that run for it: "chase.py"
  int teamNumber = 0;                 ///< of its team in the GameController
  /// The rows were made of the recording of another program: of which one.
  std::string recordedBy;
  std::string linkOf;     ///< the rows are about the link of the robot with this name
  bool live = false;      ///< the rows are messages of a live robot
  std::string sender;     ///< address from which its messages come
  std::string sentFrom;   ///< address from which its blackboard is sent
  bool attached = false;  ///< its blackboard is on the computer that records
  std::vector<std::string> formerNames;  ///< of its group, the oldest first (robot_names.h)
  std::optional<int> boardKey;           ///< System V key of its blackboard; 0: on the heap
  std::optional<bool> imuStartsAt180;
  std::optional<double> rate_hz, timeout_s;  ///< of a received blackboard
  std::optional<BatteryVolts> battery;       ///< of its model, as the next three
  std::optional<double> radius_m, fieldOfView_deg, visionRange_m;
  int shirt = 0;    ///< only in sessions of version 0.8: the number on the shirt
  std::string was;  ///< only in sessions before 0.22: the group's name before it was renamed
  bool operator==(const RobotFacts&) const = default;
};

struct MatchFacts {
  std::string physics;
  std::optional<std::uint64_t> seed;
  std::optional<double> tickRate_hz;
  bool operator==(const MatchFacts&) const = default;
};

}  // namespace pitchboard::telemetry
