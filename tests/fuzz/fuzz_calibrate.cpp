// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as the rows of a robot's blackboard, all the way to a robot model and its report. The
// first byte chooses how much of a second is between rows; each row takes a byte that says which of
// the variables change, and then four bytes for each that does.
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <robotlink/calibrate/calibration_file.h>
#include <robotlink/models/robot_models.h>
#include <telemetry/series/series_store.h>

using namespace pitchboard;

namespace {

struct Variable {
  const char* name;
  telemetry::ColumnType type;
};
// Eight at a time belong to a byte that says which of them change.
constexpr std::array<Variable, 24> variables{{
    {"CONTROL_ACTION", telemetry::ColumnType::Int32},
    {"DECISION_ACTION_B", telemetry::ColumnType::Int32},
    {"CONTROL_MOVING", telemetry::ColumnType::Int32},
    {"IMU_EULER_Z", telemetry::ColumnType::Float32},
    {"IMU_STATE", telemetry::ColumnType::Int32},
    {"VISION_BALL_DIST", telemetry::ColumnType::Float32},
    {"VISION_BALL_ANGLE", telemetry::ColumnType::Float32},
    {"VISION_LOST", telemetry::ColumnType::Int32},
    {"VISION_BLUE_LANDMARK_DEG", telemetry::ColumnType::Float32},
    {"VISION_RED_LANDMARK_DEG", telemetry::ColumnType::Float32},
    {"VISION_YELLOW_LANDMARK_DEG", telemetry::ColumnType::Float32},
    {"VISION_PURPLE_LANDMARK_DEG", telemetry::ColumnType::Float32},
    {"LOCALIZATION_X", telemetry::ColumnType::Int32},
    {"LOCALIZATION_Y", telemetry::ColumnType::Int32},
    {"LOCALIZATION_THETA", telemetry::ColumnType::Int32},
    {"LOCALIZATION_BELIEF", telemetry::ColumnType::Float32},
    {"VISION_RBT01_DIST", telemetry::ColumnType::Float32},
    {"VISION_RBT01_ANGLE", telemetry::ColumnType::Float32},
    {"VISION_RBT02_DIST", telemetry::ColumnType::Float32},
    {"VISION_RBT02_ANGLE", telemetry::ColumnType::Float32},
    {"DECISION_ACTION_VISION", telemetry::ColumnType::Int32},
    {"DECISION_SEARCH_ON", telemetry::ColumnType::Int32},
    {"DECISION_ACTION_A", telemetry::ColumnType::Int32},
    {"PLANNING_UNUSED", telemetry::ColumnType::Float32},
}};

telemetry::GroupInfo robotGroup() {
  telemetry::GroupInfo group;
  group.name = "B1";
  group.robot.emplace().team = TeamColor::Blue;
  for (const Variable& variable : variables) {
    auto& column = group.columns.emplace_back();
    column.name = variable.name;
    column.type = variable.type;
  }
  return group;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size < 2) return 0;
  static const sim::RobotModel base = link::loadRobotModel("kid-size").value();
  const double step = (1.0 + data[0]) / 60.0;
  telemetry::SeriesStore rows;
  const telemetry::GroupId group = rows.addGroup(robotGroup());
  std::array<std::uint32_t, variables.size()> words{};
  double time = 0.0;
  std::size_t at = 1;
  while (at < size) {
    for (std::size_t first = 0; first < words.size() && at < size; first += 8) {
      const unsigned char changed = data[at++];
      for (std::size_t i = 0; i < 8; ++i) {
        if ((changed >> i & 1U) == 0 || at + 4 > size) continue;
        std::memcpy(&words[first + i], data + at, 4);
        at += 4;
      }
    }
    rows.append(group, {time, words, {}});
    time += step;
  }
  const auto log = link::readCalibrationLog(rows, *sim::fieldByName("kid-2020"), "any", "B1");
  if (!log) {
    if (log.error().message.empty()) std::abort();
    return 0;
  }
  const auto made = link::calibrate(std::span(&*log, 1), base);
  if (!made) {
    if (made.error().message.empty()) std::abort();
    return 0;
  }
  for (const link::CalibratedValue& value : made->values) {
    if (!std::isfinite(value.value) || !(value.low <= value.value && value.value <= value.high)) {
      std::abort();
    }
  }
  if (!sim::validate(made->model)) std::abort();
  const std::string file = link::calibrationToJson(*made, "fuzz");
  if (!link::robotModelFromText(file, "file")) std::abort();
  if (link::calibrationReport(*made, log->field).empty()) std::abort();
  return 0;
}
