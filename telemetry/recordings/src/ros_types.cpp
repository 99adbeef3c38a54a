// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros_types.h"

#include <algorithm>
#include <array>

namespace pitchboard::telemetry {
namespace {

struct RosUnitRow {
  std::string_view type, field, unit;
};

// Source: the comments of the definitions of common_interfaces and geometry2 (ROS 2 Humble).
constexpr std::array rosUnits{
    RosUnitRow{"geometry_msgs/Pose", "position", "m"},
    RosUnitRow{"geometry_msgs/Transform", "translation", "m"},
    RosUnitRow{"geometry_msgs/Twist", "linear", "m/s"},
    RosUnitRow{"geometry_msgs/Twist", "angular", "rad/s"},
    RosUnitRow{"geometry_msgs/Accel", "linear", "m/s²"},
    RosUnitRow{"geometry_msgs/Accel", "angular", "rad/s²"},
    RosUnitRow{"geometry_msgs/Wrench", "force", "N"},
    RosUnitRow{"geometry_msgs/Wrench", "torque", "N·m"},
    RosUnitRow{"geometry_msgs/Pose2D", "x", "m"},
    RosUnitRow{"geometry_msgs/Pose2D", "y", "m"},
    RosUnitRow{"geometry_msgs/Pose2D", "theta", "rad"},
    RosUnitRow{"geometry_msgs/PointStamped", "point", "m"},
    RosUnitRow{"sensor_msgs/Imu", "angular_velocity", "rad/s"},
    RosUnitRow{"sensor_msgs/Imu", "linear_acceleration", "m/s²"},
    RosUnitRow{"sensor_msgs/JointState", "position", "rad"},
    RosUnitRow{"sensor_msgs/JointState", "velocity", "rad/s"},
    RosUnitRow{"sensor_msgs/JointState", "effort", "N·m"},
    RosUnitRow{"sensor_msgs/BatteryState", "voltage", "V"},
    RosUnitRow{"sensor_msgs/BatteryState", "cell_voltage", "V"},
    RosUnitRow{"sensor_msgs/BatteryState", "temperature", "°C"},
    RosUnitRow{"sensor_msgs/BatteryState", "cell_temperature", "°C"},
    RosUnitRow{"sensor_msgs/BatteryState", "current", "A"},
    RosUnitRow{"sensor_msgs/BatteryState", "charge", "Ah"},
    RosUnitRow{"sensor_msgs/BatteryState", "capacity", "Ah"},
    RosUnitRow{"sensor_msgs/BatteryState", "design_capacity", "Ah"},
    RosUnitRow{"sensor_msgs/BatteryState", "percentage", "1"},
    RosUnitRow{"sensor_msgs/Range", "range", "m"},
    RosUnitRow{"sensor_msgs/Range", "field_of_view", "rad"},
    RosUnitRow{"sensor_msgs/Range", "min_range", "m"},
    RosUnitRow{"sensor_msgs/Range", "max_range", "m"},
    RosUnitRow{"sensor_msgs/Temperature", "temperature", "°C"},
    RosUnitRow{"sensor_msgs/FluidPressure", "fluid_pressure", "Pa"},
    RosUnitRow{"sensor_msgs/MagneticField", "magnetic_field", "T"},
    RosUnitRow{"sensor_msgs/Illuminance", "illuminance", "lx"},
    RosUnitRow{"sensor_msgs/NavSatFix", "latitude", "°"},
    RosUnitRow{"sensor_msgs/NavSatFix", "longitude", "°"},
    RosUnitRow{"sensor_msgs/NavSatFix", "altitude", "m"},
    RosUnitRow{"sensor_msgs/LaserScan", "angle_min", "rad"},
    RosUnitRow{"sensor_msgs/LaserScan", "angle_max", "rad"},
    RosUnitRow{"sensor_msgs/LaserScan", "range_min", "m"},
    RosUnitRow{"sensor_msgs/LaserScan", "range_max", "m"},
};

void markFields(RosStruct& type) {
  const bool hasLists = std::ranges::any_of(type.fields, [](const RosField& field) {
    return field.list != RosList::One && field.kind <= RosKind::LongDouble;
  });
  for (RosField& field : type.fields) {
    const bool isText = field.kind == RosKind::Text;
    field.namesElement = isText && field.list == RosList::One && isElementName(field.name);
    field.namesLists =
        isText && field.list == RosList::Sequence && hasLists && isNameList(field.name);
    field.isStamp =
        field.kind == RosKind::Time && field.list == RosList::One && isStampName(field.name);
    if (field.unit.empty()) field.unit = rosUnit(type.name, field.name);
    if (field.kind == RosKind::Time || field.kind == RosKind::TimeSpan) field.unit = "s";
  }
}

/// How deep the structs below this one go; too deep if it contains itself.
int depthOf(const RosTypes& types, std::size_t index, std::vector<int>& known, int above) {
  if (above > maxRecordedDepth) return above;
  if (known[index] >= 0) return known[index];
  int deepest = 0;
  for (const RosField& field : types.structs[index].fields) {
    if (field.kind != RosKind::Struct) continue;
    deepest = std::max(deepest, 1 + depthOf(types, field.type, known, above + 1));
    if (deepest > maxRecordedDepth) return deepest;
  }
  return known[index] = deepest;
}

}  // namespace

std::string rosUnit(std::string_view type, std::string_view field) {
  for (const RosUnitRow& row : rosUnits) {
    if (row.type == type && row.field == field) return std::string(row.unit);
  }
  return {};
}

Result<void> completeRosTypes(RosTypes& types) {
  for (RosStruct& type : types.structs) markFields(type);
  std::vector<int> known(types.structs.size(), -1);
  if (depthOf(types, types.root, known, 0) > maxRecordedDepth) {
    return failure(ErrorCode::ParseError, "The type \"" + types.structs[types.root].name +
                                              "\" contains itself, or is nested too deep.");
  }
  return {};
}

}  // namespace pitchboard::telemetry
