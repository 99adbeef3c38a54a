// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A recorded trace of the published simulator as values: see docs/conformance.md. Units are those
// of the file: window centimetres, degrees.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <base/result.h>
#include <base/team_color.h>

namespace pitchboard::link {

struct TraceRobot {
  double x = 0.0, y = 0.0, rotate = 0.0;
  TeamColor team = TeamColor::Blue;
  bool imuStartsAt180 = false;
  std::vector<std::pair<std::string, int>> initialInts;  ///< blackboard variables
};

// Operations of the schedule; robots count from 1 in the file, from 0 here.
struct WriteInt {
  std::size_t robot;
  std::string variable;
  int value;
};
struct WriteFloat {
  std::size_t robot;
  std::string variable;
  double value;
};
struct PlaceTraceRobot {
  std::size_t robot;
  double x, y, rotate, view;
};
struct NewBall {
  double x, y;
};
struct MoveBall {
  double speed, angle;
};
struct StopGame {
  bool stopped;
};
using TraceOperation =
    std::variant<WriteInt, WriteFloat, PlaceTraceRobot, NewBall, MoveBall, StopGame>;

struct ScheduledOperation {
  int frame = 0;
  TraceOperation operation;
};

struct Trace {
  std::string name;
  int frames = 0;      ///< steps recorded; rows = frames + 1
  int crashFrame = 0;  ///< the published program died in this step; 0 = it did not
  int naiveEvery = 0;  ///< 0 = no decision process
  double ballX = 0.0, ballY = 0.0, ballFriction = 0.95;
  std::vector<TraceRobot> robots;
  std::vector<ScheduledOperation> schedule;  ///< by frame, order of the file within a frame

  std::vector<std::string> columns;
  /// One row of `columns.size()` values per step, row 0 the initial state.
  std::vector<std::vector<double>> rows;
};

Result<Trace> readTrace(const std::string& jsonPath);

}  // namespace pitchboard::link
