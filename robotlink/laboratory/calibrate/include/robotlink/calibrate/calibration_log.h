// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The data of a robot that calibration needs: commands, IMU, percepts and believed poses. They are
// read from a session file or from rows in memory, of simulated or real robots. Columns that only
// exist in a simulation (truth, belief errors) are not read. Metres, radians (left positive),
// seconds of the source. Plain values; reading is for one thread at a time.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <simcore/world/field.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// The blackboard at one moment. A percept is set only in the row in which it is new.
struct CalibrationRow {
  struct Seen {
    double distance = 0.0;  ///< m
    double bearing = 0.0;   ///< rad, left positive
  };
  struct Belief {
    Pose pose;
    double sigma = 0.0;  ///< m, as the robot reported it
  };
  double time = 0.0;
  int action = 0;                ///< CONTROL_ACTION, or DECISION_ACTION_A if that is missing
  int actionB = 0;               ///< DECISION_ACTION_B
  std::optional<bool> moving;    ///< CONTROL_MOVING
  std::optional<double> imuYaw;  ///< IMU_EULER_Z
  bool fallen = false;           ///< IMU_STATE
  bool looksForBall = true;      ///< DECISION_ACTION_VISION is 0
  bool searches = false;         ///< DECISION_SEARCH_ON
  std::optional<bool> ballLost;  ///< VISION_LOST
  std::optional<Seen> ball;
  std::array<std::optional<double>, 4> corners;  ///< blue, red, yellow, purple
  std::optional<Belief> belief;
};

/// A robot that was seen (VISION_RBTnn), with the row in which the percept was new.
struct SeenRobotPercept {
  std::size_t row = 0;
  int robot = 0;
  CalibrationRow::Seen seen;
};

/// Where a team-mate of the same recording saw this robot, by what it believed of its own place.
struct TeamMateSighting {
  std::size_t row = 0;    ///< the next row of this robot
  std::string mate;       ///< "B2"
  Point place;            ///< m, of this robot
  double distance = 0.0;  ///< m, between the two
  double sigma = 0.0;     ///< m, of the team-mate's position, as it reported it
};

struct CalibrationLog {
  std::string session;  ///< name of the file, for messages
  std::string robot;    ///< "B1"
  sim::FieldSpec field;
  std::vector<CalibrationRow> rows;  ///< in order of time
  std::vector<SeenRobotPercept> robots;
  std::vector<TeamMateSighting> sightings;
  double period = 0.0;                 ///< s, median time between rows
  std::vector<std::string> variables;  ///< those of the variables above that were recorded
  std::vector<std::string> notes;      ///< gaps, missing variables, damage, in sentences
  bool has(std::string_view variable) const;
};

/// Errors: NotFound if the session has no such robot (the message lists its robots) or no rows of
/// it, InvalidArgument if none of its variables can be used.
Result<CalibrationLog> readCalibrationLog(const telemetry::SessionReader& session,
                                          const std::string& name, const std::string& robot,
                                          telemetry::TimeRange range = {-1e18, 1e18});
Result<CalibrationLog> readCalibrationLog(const telemetry::SeriesStore& rows,
                                          const sim::FieldSpec& field, const std::string& name,
                                          const std::string& robot,
                                          telemetry::TimeRange range = {-1e18, 1e18});

/// Returns the corners of the field in the order of CalibrationRow::corners.
std::array<Point, 4> fieldCorners(const sim::FieldSpec& field);

}  // namespace pitchboard::link
