// SPDX-License-Identifier: GPL-3.0-or-later
#include "topic_robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <base/angles.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/robot_uids.h>
#include <robotlink/live/topic_robots.h>
#include <simcore/world/published_frame.h>
#include <telemetry/formats/meanings.h>

namespace pitchboard::link {
namespace {

using telemetry::ColumnKind;
using telemetry::ColumnType;
using telemetry::FieldMeaning;
using telemetry::RecordedMessage;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double priorityHold = 2.0;  // s; then a pose of lower priority counts, too

/// The first columns have a meaning in messages and on the blackboard, and its name and unit.
constexpr std::array<FieldMeaning, 8> columnMeanings{FieldMeaning::X,
                                                     FieldMeaning::Y,
                                                     FieldMeaning::Theta,
                                                     FieldMeaning::Belief,
                                                     FieldMeaning::BallDistance,
                                                     FieldMeaning::BallAngle,
                                                     FieldMeaning::Voltage,
                                                     FieldMeaning::Charge};

std::vector<telemetry::ColumnInfo> robotColumns() {
  std::vector<telemetry::ColumnInfo> columns;
  const auto add = [&columns](std::string_view name, std::string_view unit,
                              std::string_view category, ColumnKind kind = ColumnKind::Number) {
    columns.push_back({std::string(name),
                       ColumnType::Float64,
                       std::string(unit),
                       std::string(category),
                       kind,
                       {}});
  };
  for (const FieldMeaning meaning : columnMeanings) {
    const telemetry::MeaningInfo& known = telemetry::info(meaning);
    add(known.variable, known.unit, known.category);
  }
  add("FALLEN", "", "Robot", ColumnKind::Flag);
  add("BELIEF_X", "m", "Belief");
  add("BELIEF_Y", "m", "Belief");
  add("BELIEF_YAW", "°", "Belief");
  return columns;
}

}  // namespace

void TopicRobot::use(const MappedRobot& from) {
  mapped = from;
  poses.clear();
  for (const MappedPose& one : mapped.poses) poses.emplace_back(one);
  ball.reset();
  batteryPaths.reset();
  fallenPaths.reset();
  if (mapped.ball) ball.emplace(*mapped.ball);
  if (mapped.battery) batteryPaths.emplace(*mapped.battery);
  if (mapped.fallen) fallenPaths.emplace(*mapped.fallen);
  if (mapped.battery && mapped.battery->full && mapped.battery->low && mapped.battery->empty) {
    battery = {*mapped.battery->full, *mapped.battery->low, *mapped.battery->empty};
  }
}

Pose TopicRobot::onField(Pose from, MappedFrame frame, const sim::FieldSpec& field) const {
  if (frame == MappedFrame::BottomLeft) {
    from.position.x -= field.halfLength();
    from.position.y -= field.halfWidth();
  }
  if (frame == MappedFrame::Centre && mapped.attacksLeft) {
    from.position = {-from.position.x, -from.position.y};
    from.yaw += std::numbers::pi;
  }
  from.yaw = wrapToPi(std::remainder(from.yaw, 2.0 * std::numbers::pi));
  return from;
}

bool TopicRobot::takesPose(int priority, double time) const {
  return priority >= posePriority || !pose || time - poseTime > priorityHold;
}

bool TopicRobot::takePose(const PosePaths& paths, const RecordedMessage& message, double time,
                          const sim::FieldSpec& field) {
  if (!takesPose(paths.mapped.priority, time)) return false;
  const auto x = paths.x.number(message), y = paths.y.number(message);
  if (!x || !y) return false;
  Pose found{{*x * paths.toMetres, *y * paths.toMetres}, 0.0};
  if (const auto yaw = paths.yaw.number(message)) found.yaw = *yaw * paths.toRadians;
  if (const auto rotation = paths.orientation.read(message)) found.yaw = rotation->yaw();
  pose = onField(found, paths.mapped.frame, field);
  posePriority = paths.mapped.priority;
  poseTime = time;
  source = paths.mapped.topic;
  sigma.reset();
  const auto varianceX = paths.varianceX.number(message),
             varianceY = paths.varianceY.number(message);
  if (varianceX && varianceY && *varianceX + *varianceY > 0.0) {
    sigma = std::sqrt((*varianceX + *varianceY) / 2.0) * paths.toMetres;
  }
  if (const auto given = paths.sigma.number(message)) sigma = *given * paths.toMetres;
  return true;
}

void TopicRobot::takeBall(const RecordedMessage& message, double time,
                          const sim::FieldSpec& field) {
  const BallPaths& paths = *ball;
  const auto seen = paths.seen.number(message);
  ballNow.reset();
  if (paths.seen.isEmpty() || (seen && *seen > 0.0)) {
    BallNow found{0.0, 0.0, time};
    const auto x = paths.x.number(message), y = paths.y.number(message);
    const auto distance = paths.distance.number(message), angle = paths.angle.number(message);
    if (distance && angle) {
      found.distance = *distance * paths.toMetres;
      found.bearing = *angle * paths.toRadians;
      ballNow = found;
    } else if (x && y) {
      Point place{*x * paths.toMetres, *y * paths.toMetres};
      if (!paths.mapped.frame) {
        found.distance = length(place);
        found.bearing = direction({}, place);
        ballNow = found;
      } else if (pose) {
        place = onField({place, 0.0}, *paths.mapped.frame, field).position;
        found.distance = pitchboard::distance(pose->position, place);
        found.bearing = wrapToPi(direction(pose->position, place) - pose->yaw);
        ballNow = found;
      }
    }
  }
}

void TopicRobot::takeBattery(const RecordedMessage& message) {
  const BatteryPaths& paths = *batteryPaths;
  volts = paths.volts.number(message);
  if (volts) volts = *volts * paths.toVolts;
  if (volts && !(*volts > 0.0)) volts.reset();
  charge = paths.charge.number(message);
  if (volts && !battery) {
    // Lithium polymer: as few cells as explain the voltage.
    const telemetry::BatteryLimits cell;
    const double cells = std::ceil(*volts / cell.fullPerCell - 1e-6);
    battery = {cells * cell.fullPerCell, cells * cell.lowPerCell, cells * cell.emptyPerCell};
    group.reset();  // is described again
  }
}

telemetry::GroupInfo TopicRobot::groupInfo(double timeout) const {
  telemetry::GroupInfo made;
  made.name = name;
  made.id = groupId(uid, RobotRows::Variables);
  made.columns = robotColumns();
  telemetry::RobotFacts& facts = made.robot.emplace();
  facts.uid = uid;
  facts.slot = mapped.number;
  facts.number = mapped.number;
  facts.team = mapped.team;
  facts.name = mapped.name;
  facts.teamNumber = teamNumber;
  facts.recordedBy = source.empty() ? std::string("another program") : source;
  facts.timeout_s = timeout;
  facts.battery = battery;
  return made;
}

void TopicRobot::fillRow(double time, const sim::FieldSpec& field) {
  if (ballNow && time - ballNow->time > TopicRobots::ballHold) ballNow.reset();
  row.fill(unknown);
  if (pose) {
    const auto cm = sim::published_frame::localizationFromStudio(field, *pose);
    row[XColumn] = cm.x;
    row[YColumn] = cm.y;
    row[ThetaColumn] = cm.degrees;
    row[BeliefXColumn] = pose->position.x;
    row[BeliefYColumn] = pose->position.y;
    row[BeliefYawColumn] = degreesFromRadians(pose->yaw);
  }
  if (sigma) row[SigmaColumn] = sim::published_frame::cmFromMetres(*sigma);
  if (ballNow) {
    row[BallDistanceColumn] = sim::published_frame::cmFromMetres(ballNow->distance);
    row[BallAngleColumn] = degreesFromRadians(ballNow->bearing);
  }
  if (volts) row[VoltageColumn] = *volts * 10.0;
  if (charge) row[ChargeColumn] = *charge * 100.0;
  if (isFallen) row[FallenColumn] = *isFallen ? 1.0 : 0.0;
}

RobotFrame TopicRobot::frame(double time, double timeout, const sim::FieldSpec& field,
                             const std::optional<Game>& game) const {
  RobotFrame made;
  made.identity = {RobotId{}, mapped.team, mapped.number, false};
  made.key = {placeByColour, mapped.number, 0};
  made.uid = uid;
  made.name = name;
  made.ownName = mapped.name;
  const double age = std::max(0.0, time - lastTime);
  made.link = boardLink(age, 0.0, age > timeout);
  made.link->messages = rows;
  made.fallen = isFallen.value_or(false);
  const RobotReader reader = [this](FieldMeaning meaning) -> std::optional<double> {
    const auto found = std::ranges::find(columnMeanings, meaning);
    if (found == columnMeanings.end()) return {};
    const double value = row[static_cast<std::size_t>(found - columnMeanings.begin())];
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  telemetry::BatteryLimits limits = telemetry::defaultBattery;
  if (battery) {
    limits = {1, battery->full, battery->low, battery->empty};
  }
  buildRobot(reader, field, limits, false, made);
  const int team = game ? game->teamNumbered(teamNumber) : Game::noTeam;
  if (team != Game::noTeam) {
    const GameTeam& own = game->teams[static_cast<std::size_t>(team)];
    made.penalty = penaltyOf(*game, own.player(mapped.number));
  }
  return made;
}

std::string TopicRobot::plainName() const {
  return std::string(info(mapped.team).letter) + std::to_string(mapped.number);
}

}  // namespace pitchboard::link
