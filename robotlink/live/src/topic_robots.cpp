// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/topic_robots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <base/angles.h>
#include <base/units.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/robot_uids.h>
#include <simcore/world/published_frame.h>
#include <telemetry/wire/meanings.h>

namespace pitchboard::link {
namespace {

using telemetry::ColumnKind;
using telemetry::ColumnType;
using telemetry::FieldMeaning;
using telemetry::RecordedKind;
using telemetry::RecordedMessage;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double fallenTilt = radiansFromDegrees(55.0), uprightTilt = radiansFromDegrees(35.0);
constexpr double priorityHold = 2.0;  // s; then a pose of lower priority counts, too
constexpr int topicSender = 300;      // of RobotKey: no other robot has it

enum Column : std::size_t {
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
  columnCount
};

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

/// The paths of a quaternion.
struct QuaternionPaths {
  explicit QuaternionPaths(const std::string& path)
      : x(path + ".x"), y(path + ".y"), z(path + ".z"), w(path + ".w") {}
  std::optional<Rotation> read(const RecordedMessage& message) const {
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

std::string plainName(const MappedRobot& robot) {
  return std::string(info(robot.team).letter) + std::to_string(robot.number);
}

std::string lastPart(const std::string& frame) {
  const auto slash = frame.rfind('/');
  return slash == frame.npos ? frame : frame.substr(slash + 1);
}

std::string prefixOf(const std::string& frame) {
  const auto slash = frame.rfind('/');
  if (slash == frame.npos || slash == 0) return {};
  return frame.substr(frame.starts_with('/') ? 1 : 0, slash - (frame.starts_with('/') ? 1 : 0));
}

bool isFieldFrame(const std::string& frame) {
  static constexpr std::array<std::string_view, 5> names{"map", "world", "field", "soccer_field",
                                                         "global"};
  return std::ranges::find(names, lastPart(frame)) != names.end();
}

bool isRobotFrame(const std::string& frame) {
  static constexpr std::array<std::string_view, 7> names{
      "base_footprint", "base_link", "torso", "trunk", "pelvis", "body", "base"};
  return std::ranges::find(names, lastPart(frame)) != names.end();
}

}  // namespace

std::optional<std::size_t> TopicPath::find(const RecordedMessage& message) const {
  if (m_path.empty()) return {};
  if (m_shape != message.shape) {
    m_shape = message.shape;
    const auto& fields = message.shape->fields;
    const auto found = std::ranges::find(fields, m_path, &telemetry::RecordedField::path);
    m_index.reset();
    if (found != fields.end()) m_index = static_cast<std::size_t>(found - fields.begin());
  }
  return m_index;
}

std::optional<double> TopicPath::number(const RecordedMessage& message) const {
  const auto place = find(message);
  if (!place || !std::isfinite(message.values[*place])) return {};
  return message.values[*place];
}

std::optional<std::string_view> TopicPath::text(const RecordedMessage& message) const {
  const auto place = find(message);
  if (!place || message.shape->fields[*place].kind != RecordedKind::Text) return {};
  const auto& fields = message.shape->fields;
  const auto before =
      std::count_if(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(*place),
                    [](const auto& field) { return field.kind == RecordedKind::Text; });
  return message.texts[static_cast<std::size_t>(before)];
}

struct TopicRobots::Robot {
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
  std::array<double, columnCount> row{};
};

TopicRobots::TopicRobots(telemetry::RowSink& rows, const TopicMapping& mapping, Options options)
    : m_rows(rows), m_options(std::move(options)) {
  for (const MappedRobot& robot : mapping.robots) add(robot);
}

TopicRobots::~TopicRobots() = default;

void TopicRobots::use(Robot& robot, const MappedRobot& mapped) {
  robot.mapped = mapped;
  robot.poses.clear();
  for (const MappedPose& pose : mapped.poses) robot.poses.emplace_back(pose);
  robot.ball.reset();
  robot.batteryPaths.reset();
  robot.fallenPaths.reset();
  if (mapped.ball) robot.ball.emplace(*mapped.ball);
  if (mapped.battery) robot.batteryPaths.emplace(*mapped.battery);
  if (mapped.fallen) robot.fallenPaths.emplace(*mapped.fallen);
  if (mapped.battery && mapped.battery->full && mapped.battery->low && mapped.battery->empty) {
    robot.battery = {*mapped.battery->full, *mapped.battery->low, *mapped.battery->empty};
  }
}

TopicRobots::Robot& TopicRobots::add(const MappedRobot& mapped) {
  auto robot = std::make_unique<Robot>();
  use(*robot, mapped);
  robot->nameInMapping = mapped.name;
  if (m_options.numberOf) robot->mapped.number = m_options.numberOf(mapped.team, mapped.number);
  return *m_robots.emplace_back(std::move(robot));
}

void TopicRobots::update(const TopicMapping& mapping) {
  for (MappedRobot mapped : mapping.robots) {
    const auto known = std::ranges::find_if(
        m_robots, [&mapped](const auto& robot) { return robot->nameInMapping == mapped.name; });
    if (known == m_robots.end()) {
      if (m_robots.size() < maxRobots) add(mapped);
      continue;
    }
    const MappedRobot& before = (*known)->mapped;
    mapped.number = before.number;
    mapped.team = before.team;
    mapped.name = before.name;
    // The frame that was found stays the robot's.
    if (mapped.transforms && before.transforms) mapped.transforms = before.transforms;
    if (mapped != before) use(**known, mapped);
  }
}

void TopicRobots::forget(RobotUid uid) {
  for (const auto& robot : m_robots) {
    if (robot->uid != uid) continue;
    robot->rows = 0;
    robot->pose.reset();
    robot->posePriority = 0;
    robot->sigma = robot->volts = robot->charge = {};
    robot->ballNow.reset();
    robot->isFallen.reset();
  }
}

bool TopicRobots::hasNumber(TeamColor team, int number) const {
  return std::ranges::any_of(m_robots, [&](const auto& robot) {
    return robot->mapped.team == team && robot->mapped.number == number;
  });
}

/// When it is first heard of: until then its number may follow from a frame.
void TopicRobots::identify(Robot& robot) {
  if (!robot.name.empty()) return;
  const MappedRobot& mapped = robot.mapped;
  robot.uid =
      uidOf(RobotKey{teamIndex(mapped.team), mapped.number, topicSender + m_options.source});
  robot.name = m_options.nameOf ? m_options.nameOf(plainName(mapped)) : plainName(mapped);
}

void TopicRobots::take(const telemetry::RecordedTopic& topic, const RecordedMessage& message,
                       double time) {
  bool isTree = false;
  for (const auto& robot : m_robots) {
    for (std::size_t i = 0; i < robot->poses.size(); ++i) {
      if (robot->poses[i].mapped.topic == topic.name) takePose(*robot, i, message, time);
    }
    const MappedRobot& mapped = robot->mapped;
    isTree = isTree || (mapped.transforms && mapped.transforms->topic == topic.name);
    if (mapped.ball && mapped.ball->topic == topic.name) takeBall(*robot, message, time);
    if (mapped.battery && mapped.battery->topic == topic.name) takeBattery(*robot, message, time);
    if (mapped.fallen && mapped.fallen->topic == topic.name) takeFallen(*robot, message, time);
  }
  // What never changes is of the same tree.
  if (isTree || topic.name == "/tf_static") takeTransforms(topic, message, time);
}

Pose TopicRobots::onField(const Robot& robot, Pose pose, MappedFrame frame) const {
  if (frame == MappedFrame::BottomLeft) {
    pose.position.x -= m_options.field.halfLength();
    pose.position.y -= m_options.field.halfWidth();
  }
  if (frame == MappedFrame::Centre && robot.mapped.attacksLeft) {
    pose.position = {-pose.position.x, -pose.position.y};
    pose.yaw += std::numbers::pi;
  }
  pose.yaw = wrapToPi(std::remainder(pose.yaw, 2.0 * std::numbers::pi));
  return pose;
}

void TopicRobots::takePose(Robot& robot, std::size_t index, const RecordedMessage& message,
                           double time) {
  const PosePaths& paths = robot.poses[index];
  const bool isOutdated = !robot.pose || time - robot.poseTime > priorityHold;
  if (paths.mapped.priority < robot.posePriority && !isOutdated) return;
  const auto x = paths.x.number(message), y = paths.y.number(message);
  if (!x || !y) return;
  Pose pose{{*x * paths.toMetres, *y * paths.toMetres}, 0.0};
  if (const auto yaw = paths.yaw.number(message)) pose.yaw = *yaw * paths.toRadians;
  if (const auto rotation = paths.orientation.read(message)) pose.yaw = rotation->yaw();
  robot.pose = onField(robot, pose, paths.mapped.frame);
  robot.posePriority = paths.mapped.priority;
  robot.poseTime = time;
  robot.source = paths.mapped.topic;
  robot.sigma.reset();
  const auto varianceX = paths.varianceX.number(message),
             varianceY = paths.varianceY.number(message);
  if (varianceX && varianceY && *varianceX + *varianceY > 0.0) {
    robot.sigma = std::sqrt((*varianceX + *varianceY) / 2.0) * paths.toMetres;
  }
  if (const auto sigma = paths.sigma.number(message)) robot.sigma = *sigma * paths.toMetres;
  write(robot, time);
}

void TopicRobots::takeTransforms(const telemetry::RecordedTopic&, const RecordedMessage& message,
                                 double time) {
  // Each transform begins with the frame that it is relative to.
  const auto& fields = message.shape->fields;
  constexpr std::string_view parentEnd = "].header.frame_id", begin = "transforms[";
  std::size_t text = 0;
  std::vector<std::string> moved;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].kind != RecordedKind::Text) continue;
    const std::string_view parent = message.texts[text++];
    if (!fields[i].path.starts_with(begin) || !fields[i].path.ends_with(parentEnd)) continue;
    // Behind it: the frame, three numbers of the translation, four of the rotation.
    if (i + 8 >= fields.size() || text >= message.texts.size()) continue;
    const std::string child(message.texts[text]);
    const auto* values = message.values.data() + i + 2;
    const auto rotation = Rotation::of(values[3], values[4], values[5], values[6]);
    const bool isFinite =
        std::all_of(values, values + 3, [](double v) { return std::isfinite(v); });
    if (!fields[i + 1].path.ends_with("].child_frame_id") || !rotation || !isFinite) continue;
    m_tree.set(child, std::string(parent), {values[0], values[1], values[2], *rotation});
    moved.push_back(child);
  }
  for (const std::string& frame : moved) takeTransformed(frame, time);
}

TopicRobots::Robot* TopicRobots::ofFrame(const std::string& frame) {
  Robot* unnamed = nullptr;
  for (const auto& robot : m_robots) {
    const auto& mapped = robot->mapped.transforms;
    if (!mapped) continue;
    if (mapped->base == frame) return robot.get();
    if (!mapped->base.empty() || !isRobotFrame(frame)) continue;
    if (robot->mapped.name == prefixOf(frame)) return robot.get();
    if (robot->mapped.name.empty()) unnamed = robot.get();
  }
  // The first prefix names the robot; further ones are further robots.
  if (unnamed != nullptr && isFieldFrame(m_tree.rootOf(frame))) {
    unnamed->mapped.name = prefixOf(frame);
    if (const auto number = numberOfName(prefixOf(frame)); number && unnamed->rows == 0) {
      const bool isTaken = std::ranges::any_of(
          m_robots, [&](const auto& one) { return one->mapped.number == *number; });
      const TeamColor team = unnamed->mapped.team;
      if (!isTaken) {
        unnamed->mapped.number = m_options.numberOf ? m_options.numberOf(team, *number) : *number;
      }
    }
    return unnamed;
  }
  return nullptr;
}

void TopicRobots::takeTransformed(const std::string& frame, double time) {
  Robot* robot = ofFrame(frame);
  if (robot == nullptr) robot = addOfFrame(frame);
  if (robot == nullptr) return;
  MappedTransforms& mapped = *robot->mapped.transforms;
  const std::string root = mapped.root.empty() ? m_tree.rootOf(frame) : mapped.root;
  // A tree that does not reach the field only says how the robot moves.
  if (mapped.root.empty() && !isFieldFrame(root)) return;
  const auto place = m_tree.find(frame, root);
  if (!place) return;
  mapped.base = frame;  // the frame that was found first is the robot's from now on
  constexpr int treePriority = 2;
  const bool isOutdated = !robot->pose || time - robot->poseTime > priorityHold;
  if (treePriority < robot->posePriority && !isOutdated) return;
  robot->posePriority = treePriority;
  robot->poseTime = time;
  robot->pose = onField(*robot, {{place->x, place->y}, place->rotation.yaw()}, mapped.frame);
  robot->source = mapped.topic;
  write(*robot, time);
}

/// A further robot of the same tree: "robot2/base_link".
TopicRobots::Robot* TopicRobots::addOfFrame(const std::string& frame) {
  const std::string prefix = prefixOf(frame);
  const auto known = std::ranges::find_if(
      m_robots, [](const auto& one) { return one->mapped.transforms.has_value(); });
  if (!isRobotFrame(frame) || prefix.empty() || known == m_robots.end() ||
      m_robots.size() >= maxRobots || !isFieldFrame(m_tree.rootOf(frame))) {
    return nullptr;
  }
  const bool isTaken = std::ranges::any_of(
      m_robots, [&prefix](const auto& one) { return one->mapped.name == prefix; });
  if (isTaken) return nullptr;  // by another frame of the same robot
  MappedRobot made;
  made.name = prefix;
  made.team = (*known)->mapped.team;
  made.transforms = (*known)->mapped.transforms;
  made.transforms->base = frame;
  for (const auto& one : m_robots) made.number = std::max(made.number, one->mapped.number + 1);
  const auto number = numberOfName(prefix);
  const bool isFree = number && std::ranges::none_of(m_robots, [&](const auto& one) {
                        return one->mapped.number == *number;
                      });
  if (isFree) made.number = *number;
  Robot& robot = add(made);
  robot.nameInMapping.reset();
  return &robot;
}

void TopicRobots::takeBall(Robot& robot, const RecordedMessage& message, double time) {
  const BallPaths& paths = *robot.ball;
  const auto seen = paths.seen.number(message);
  robot.ballNow.reset();
  if (paths.seen.isEmpty() || (seen && *seen > 0.0)) {
    BallNow ball{0.0, 0.0, time};
    const auto x = paths.x.number(message), y = paths.y.number(message);
    const auto distance = paths.distance.number(message), angle = paths.angle.number(message);
    if (distance && angle) {
      ball.distance = *distance * paths.toMetres;
      ball.bearing = *angle * paths.toRadians;
      robot.ballNow = ball;
    } else if (x && y) {
      Point place{*x * paths.toMetres, *y * paths.toMetres};
      if (!paths.mapped.frame) {
        ball.distance = length(place);
        ball.bearing = direction({}, place);
        robot.ballNow = ball;
      } else if (robot.pose) {
        place = onField(robot, {place, 0.0}, *paths.mapped.frame).position;
        ball.distance = pitchboard::distance(robot.pose->position, place);
        ball.bearing = wrapToPi(direction(robot.pose->position, place) - robot.pose->yaw);
        robot.ballNow = ball;
      }
    }
  }
  write(robot, time);
}

void TopicRobots::takeBattery(Robot& robot, const RecordedMessage& message, double time) {
  const BatteryPaths& paths = *robot.batteryPaths;
  robot.volts = paths.volts.number(message);
  if (robot.volts) robot.volts = *robot.volts * paths.toVolts;
  if (robot.volts && !(*robot.volts > 0.0)) robot.volts.reset();
  robot.charge = paths.charge.number(message);
  if (robot.volts && !robot.battery) {
    // Lithium polymer: as few cells as explain the voltage.
    const telemetry::BatteryLimits cell;
    const double cells = std::ceil(*robot.volts / cell.fullPerCell - 1e-6);
    robot.battery = {cells * cell.fullPerCell, cells * cell.lowPerCell, cells * cell.emptyPerCell};
    robot.group.reset();  // is described again
  }
  write(robot, time);
}

void TopicRobots::setFallen(Robot& robot, bool isFallen, double time) {
  const bool was = robot.isFallen.value_or(false);
  robot.isFallen = isFallen;
  if (was == isFallen) return;
  identify(robot);
  m_events.push_back(eventOf(isFallen ? MatchEventKind::Fall : MatchEventKind::GotUp, time,
                             robot.uid, robot.name));
  write(robot, time);
}

void TopicRobots::takeFallen(Robot& robot, const RecordedMessage& message, double time) {
  const FallenPaths& paths = *robot.fallenPaths;
  if (const auto flag = paths.flag.number(message)) return setFallen(robot, *flag != 0.0, time);
  const auto rotation = paths.orientation.read(message);
  if (!rotation) return;
  const double tilt = rotation->tilt();
  const bool was = robot.isFallen.value_or(false);
  setFallen(robot, was ? tilt > uprightTilt : tilt > fallenTilt, time);
}

TopicRobots::Robot* TopicRobots::replying(const telemetry::RobotReply& reply, const Game& game) {
  const int index = game.teamNumbered(reply.team);
  if (index == Game::noTeam) return nullptr;
  for (const auto& robot : m_robots) {
    if (robot->teamNumber == reply.team && robot->mapped.number == reply.player) return robot.get();
  }
  if (m_robots.size() >= maxRobots) return nullptr;
  const GameTeam &own = game.teams[static_cast<std::size_t>(index)],
                 &other = game.teams[static_cast<std::size_t>(1 - index)];
  // Robots can have five colours, the referee's teams more.
  const auto colour = robotColor(own.colour), theirs = robotColor(other.colour);
  MappedRobot made;
  made.number = reply.player;
  made.team = colour ? *colour : theirs == TeamColor::Blue ? TeamColor::Red : TeamColor::Blue;
  if (!colour && !theirs && index == 1) made.team = TeamColor::Red;
  Robot& robot = add(made);
  robot.nameInMapping.reset();
  robot.teamNumber = reply.team;
  robot.source = "referee's log";
  return &robot;
}

void TopicRobots::take(const telemetry::RobotReply& reply, const Game& game, double time) {
  constexpr double metres = 0.001;
  Robot* robot = replying(reply, game);
  if (robot == nullptr) {
    ++m_refused;
    return;
  }
  const auto isFinite = [](const auto& numbers) {
    return std::ranges::all_of(numbers, [](float f) { return std::isfinite(f); });
  };
  // Robots count +x towards the opponents' goal.
  const auto index = static_cast<std::size_t>(game.teamNumbered(reply.team));
  robot->mapped.attacksLeft = !game.attacksRight(index);
  if (reply.pose && isFinite(*reply.pose)) {
    const auto& [x, y, yaw] = *reply.pose;
    robot->pose = onField(*robot,
                          {{static_cast<double>(x) * metres, static_cast<double>(y) * metres},
                           static_cast<double>(yaw)},
                          MappedFrame::Centre);
  }
  robot->ballNow.reset();
  const bool hasBall = reply.ball && reply.ballAge && *reply.ballAge >= 0.0F &&
                       static_cast<double>(*reply.ballAge) < ballHold && isFinite(*reply.ball);
  if (hasBall) {
    const Point place{static_cast<double>((*reply.ball)[0]) * metres,
                      static_cast<double>((*reply.ball)[1]) * metres};
    robot->ballNow = BallNow{length(place), direction({}, place), time};
  }
  if (reply.fallen) setFallen(*robot, *reply.fallen != 0, time);
  write(*robot, time);
}

telemetry::GroupInfo TopicRobots::groupOf(const Robot& robot) const {
  telemetry::GroupInfo group;
  group.name = robot.name;
  group.id = groupId(robot.uid, RobotRows::Variables);
  group.columns = robotColumns();
  telemetry::RobotFacts& facts = group.robot.emplace();
  facts.uid = robot.uid;
  facts.slot = robot.mapped.number;
  facts.number = robot.mapped.number;
  facts.team = robot.mapped.team;
  facts.name = robot.mapped.name;
  facts.teamNumber = robot.teamNumber;
  facts.recordedBy = robot.source.empty() ? std::string("another program") : robot.source;
  facts.timeout_s = m_options.timeout;
  facts.battery = robot.battery;
  return group;
}

void TopicRobots::write(Robot& robot, double time) {
  identify(robot);
  if (!robot.group) robot.group = m_rows.addGroup(groupOf(robot));
  time = std::max(time, robot.lastTime);
  if (robot.ballNow && time - robot.ballNow->time > ballHold) robot.ballNow.reset();
  auto& row = robot.row;
  row.fill(unknown);
  if (robot.pose) {
    const auto cm = sim::published_frame::localizationFromStudio(m_options.field, *robot.pose);
    row[XColumn] = cm.x;
    row[YColumn] = cm.y;
    row[ThetaColumn] = cm.degrees;
    row[BeliefXColumn] = robot.pose->position.x;
    row[BeliefYColumn] = robot.pose->position.y;
    row[BeliefYawColumn] = degreesFromRadians(robot.pose->yaw);
  }
  if (robot.sigma) row[SigmaColumn] = sim::published_frame::cmFromMetres(*robot.sigma);
  if (robot.ballNow) {
    row[BallDistanceColumn] = sim::published_frame::cmFromMetres(robot.ballNow->distance);
    row[BallAngleColumn] = degreesFromRadians(robot.ballNow->bearing);
  }
  if (robot.volts) row[VoltageColumn] = *robot.volts * 10.0;
  if (robot.charge) row[ChargeColumn] = *robot.charge * 100.0;
  if (robot.isFallen) row[FallenColumn] = *robot.isFallen ? 1.0 : 0.0;
  m_rows.append(*robot.group, {time, {}, row});
  robot.lastTime = time;
  ++robot.rows;
}

std::vector<RobotFrame> TopicRobots::frames(double time, const std::optional<Game>& game) const {
  std::vector<RobotFrame> frames;
  for (const auto& robot : m_robots) {
    if (robot->rows == 0) continue;
    RobotFrame& frame = frames.emplace_back();
    frame.identity = {RobotId{}, robot->mapped.team, robot->mapped.number, false};
    frame.key = {placeByColour, robot->mapped.number, 0};
    frame.uid = robot->uid;
    frame.name = robot->name;
    frame.ownName = robot->mapped.name;
    const double age = std::max(0.0, time - robot->lastTime);
    frame.link = boardLink(age, 0.0, age > m_options.timeout);
    frame.link->messages = robot->rows;
    frame.fallen = robot->isFallen.value_or(false);
    const RobotReader reader = [&row = robot->row](FieldMeaning meaning) -> std::optional<double> {
      const auto found = std::ranges::find(columnMeanings, meaning);
      if (found == columnMeanings.end()) return {};
      const double value = row[static_cast<std::size_t>(found - columnMeanings.begin())];
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    telemetry::BatteryLimits limits = telemetry::defaultBattery;
    if (robot->battery) {
      limits = {1, robot->battery->full, robot->battery->low, robot->battery->empty};
    }
    buildRobot(reader, m_options.field, limits, false, frame);
    const int team = game ? game->teamNumbered(robot->teamNumber) : Game::noTeam;
    if (team != Game::noTeam) {
      const GameTeam& own = game->teams[static_cast<std::size_t>(team)];
      frame.penalty = penaltyOf(*game, own.player(robot->mapped.number));
    }
  }
  return frames;
}

std::string TopicRobots::sourceOf(RobotUid uid) const {
  for (const auto& robot : m_robots) {
    if (robot->uid == uid) return robot->source;
  }
  return {};
}

std::vector<std::string> TopicRobots::names() const {
  std::vector<const Robot*> seen;
  for (const auto& robot : m_robots) {
    if (robot->rows > 0) seen.push_back(robot.get());
  }
  std::ranges::stable_sort(seen, {}, [](const Robot* robot) {
    return std::pair(robot->mapped.team, robot->mapped.number);
  });
  std::vector<std::string> names;
  for (const Robot* robot : seen) names.push_back(robot->name);
  return names;
}

std::uint64_t TopicRobots::variables() const {
  return names().size() * columnCount;
}

void TopicRobots::addNotes(std::vector<std::string>& notes) const {
  for (const auto& robot : m_robots) {
    if (robot->rows > 0) continue;
    notes.push_back("Robot " + plainName(robot->mapped) +
                    ": no message has the values that the mapping names for it.");
  }
  if (m_refused > 0) {
    notes.push_back(std::to_string(m_refused) +
                    " replies of robots are of a team that does not play, or of too many robots.");
  }
}

}  // namespace pitchboard::link
