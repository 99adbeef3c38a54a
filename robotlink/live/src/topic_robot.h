// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known of one robot of topics (topic_robots.h), and the row and frame made of it. Private
// to live. Times are seconds of the source. Not thread-safe.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/units.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/live/topic_mapping.h>
#include <robotlink/live/topic_path.h>
#include <robotlink/live/transform_tree.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

enum TopicRobotColumn : std::size_t {
  XColumn,
  YColumn,
  ThetaColumn,
  SigmaColumn,
  BallDistanceColumn,
  BallAngleColumn,
  VoltageColumn,
  ChargeColumn,
  FallenColumn,
  BeliefXColumn,
  BeliefYColumn,
  BeliefYawColumn,
  topicRobotColumns
};

/// The paths of a quaternion.
struct QuaternionPaths {
  explicit QuaternionPaths(const std::string& path)
      : x(path + ".x"), y(path + ".y"), z(path + ".z"), w(path + ".w") {}
  std::optional<Rotation> read(const telemetry::RecordedMessage& message) const {
    const auto qx = x.number(message), qy = y.number(message), qz = z.number(message),
               qw = w.number(message);
    if (!qx || !qy || !qz || !qw) return {};
    return Rotation::of(*qx, *qy, *qz, *qw);
  }
  TopicPath x, y, z, w;
};

struct PosePaths {
  explicit PosePaths(const MappedPose& from)
      : mapped(from),
        x(from.x),
        y(from.y),
        yaw(from.yaw),
        orientation(from.orientation),
        varianceX(from.covariance + "[0]"),
        varianceY(from.covariance + "[7]"),
        sigma(from.sigma),
        toMetres(unitFactor(from.unit, "m").value_or(1.0)),
        toRadians(unitFactor(from.angleUnit, "rad").value_or(1.0)) {}
  MappedPose mapped;
  TopicPath x, y, yaw;
  QuaternionPaths orientation;
  TopicPath varianceX, varianceY, sigma;
  double toMetres, toRadians;
};

struct BallPaths {
  explicit BallPaths(const MappedBall& from)
      : mapped(from),
        x(from.x),
        y(from.y),
        distance(from.distance),
        angle(from.angle),
        seen(from.seen),
        toMetres(unitFactor(from.unit, "m").value_or(1.0)),
        toRadians(unitFactor(from.angleUnit, "rad").value_or(1.0)) {}
  MappedBall mapped;
  TopicPath x, y, distance, angle, seen;
  double toMetres, toRadians;
};

struct BatteryPaths {
  explicit BatteryPaths(const MappedBattery& from)
      : mapped(from),
        volts(from.volts),
        charge(from.charge),
        toVolts(unitFactor(from.unit, "V").value_or(1.0)) {}
  MappedBattery mapped;
  TopicPath volts, charge;
  double toVolts;
};

struct FallenPaths {
  explicit FallenPaths(const MappedFallen& from)
      : mapped(from), orientation(from.orientation), flag(from.flag) {}
  MappedFallen mapped;
  QuaternionPaths orientation;
  TopicPath flag;
};

struct BallNow {
  double distance = 0.0, bearing = 0.0;  ///< m, rad, left positive
  double time = 0.0;
};

struct TopicRobot {
  MappedRobot mapped;
  std::optional<std::string> nameInMapping;  ///< empty: found in messages only
  RobotUid uid;
  std::string name, source;
  int teamNumber = 0;
  std::optional<telemetry::BatteryVolts> battery;

  std::vector<PosePaths> poses;
  std::optional<BallPaths> ball;
  std::optional<BatteryPaths> batteryPaths;
  std::optional<FallenPaths> fallenPaths;

  std::optional<Pose> pose;
  int posePriority = 0;
  double poseTime = 0.0;
  std::optional<double> sigma, volts, charge;
  std::optional<BallNow> ballNow;
  std::optional<bool> isFallen;

  std::optional<telemetry::GroupId> group;
  double lastTime = 0.0;  ///< of its last row
  std::uint64_t rows = 0;
  std::array<double, topicRobotColumns> row{};

  /// Finds the values of another mapping from now on.
  void use(const MappedRobot& from);
  /// Each takes what a message says; the poses' false: it says nothing, or another pose counts.
  bool takePose(const PosePaths& paths, const telemetry::RecordedMessage& message, double time,
                const sim::FieldSpec& field);
  void takeBall(const telemetry::RecordedMessage& message, double time,
                const sim::FieldSpec& field);
  void takeBattery(const telemetry::RecordedMessage& message);
  /// Returns whether a pose of this priority counts now.
  bool takesPose(int priority, double time) const;
  /// Returns a pose that is counted from `frame` in the frame of the field.
  Pose onField(Pose from, MappedFrame frame, const sim::FieldSpec& field) const;
  void fillRow(double time, const sim::FieldSpec& field);
  telemetry::GroupInfo groupInfo(double timeout) const;
  RobotFrame frame(double time, double timeout, const sim::FieldSpec& field,
                   const std::optional<Game>& game) const;
  std::string plainName() const;  ///< "B3"
};

}  // namespace pitchboard::link
