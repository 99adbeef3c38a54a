// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/topic_robots.h>

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <robotlink/live/robot_uids.h>

#include "topic_frames.h"
#include "topic_robot.h"

namespace pitchboard::link {
namespace {

using telemetry::RecordedMessage;

constexpr double fallenTilt = radiansFromDegrees(55.0), uprightTilt = radiansFromDegrees(35.0);
constexpr int topicSender = 300;  // of RobotKey: no other robot has it

}  // namespace

TopicRobots::TopicRobots(telemetry::RowSink& rows, const TopicMapping& mapping, Options options)
    : m_rows(rows), m_options(std::move(options)) {
  for (const MappedRobot& robot : mapping.robots) add(robot);
}

TopicRobots::~TopicRobots() = default;

TopicRobot& TopicRobots::add(const MappedRobot& mapped) {
  auto robot = std::make_unique<TopicRobot>();
  robot->use(mapped);
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
    if (mapped != before) (*known)->use(mapped);
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
void TopicRobots::identify(TopicRobot& robot) {
  if (!robot.name.empty()) return;
  const MappedRobot& mapped = robot.mapped;
  robot.uid =
      uidOf(RobotKey{teamIndex(mapped.team), mapped.number, topicSender + m_options.source});
  robot.name = m_options.nameOf ? m_options.nameOf(robot.plainName()) : robot.plainName();
}

void TopicRobots::take(const telemetry::RecordedTopic& topic, const RecordedMessage& message,
                       double time) {
  bool isTree = false;
  for (const auto& robot : m_robots) {
    for (std::size_t i = 0; i < robot->poses.size(); ++i) {
      if (robot->poses[i].mapped.topic != topic.name) continue;
      if (robot->takePose(robot->poses[i], message, time, m_options.field)) write(*robot, time);
    }
    const MappedRobot& mapped = robot->mapped;
    isTree = isTree || (mapped.transforms && mapped.transforms->topic == topic.name);
    if (mapped.ball && mapped.ball->topic == topic.name) {
      robot->takeBall(message, time, m_options.field);
      write(*robot, time);
    }
    if (mapped.battery && mapped.battery->topic == topic.name) {
      robot->takeBattery(message);
      write(*robot, time);
    }
    if (mapped.fallen && mapped.fallen->topic == topic.name) takeFallen(*robot, message, time);
  }
  // What never changes is of the same tree.
  if (!isTree && topic.name != "/tf_static") return;
  for (const std::string& frame : takeTransforms(message, m_tree)) takeTransformed(frame, time);
}

TopicRobot* TopicRobots::ofFrame(const std::string& frame) {
  TopicRobot* unnamed = nullptr;
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
  TopicRobot* robot = ofFrame(frame);
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
  if (!robot->takesPose(treePriority, time)) return;
  robot->posePriority = treePriority;
  robot->poseTime = time;
  robot->pose =
      robot->onField({{place->x, place->y}, place->rotation.yaw()}, mapped.frame, m_options.field);
  robot->source = mapped.topic;
  write(*robot, time);
}

/// A further robot of the same tree: "robot2/base_link".
TopicRobot* TopicRobots::addOfFrame(const std::string& frame) {
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
  TopicRobot& robot = add(made);
  robot.nameInMapping.reset();
  return &robot;
}

void TopicRobots::setFallen(TopicRobot& robot, bool isFallen, double time) {
  const bool was = robot.isFallen.value_or(false);
  robot.isFallen = isFallen;
  if (was == isFallen) return;
  identify(robot);
  m_events.push_back(eventOf(isFallen ? MatchEventKind::Fall : MatchEventKind::GotUp, time,
                             robot.uid, robot.name));
  write(robot, time);
}

void TopicRobots::takeFallen(TopicRobot& robot, const RecordedMessage& message, double time) {
  const FallenPaths& paths = *robot.fallenPaths;
  if (const auto flag = paths.flag.number(message)) return setFallen(robot, *flag != 0.0, time);
  const auto rotation = paths.orientation.read(message);
  if (!rotation) return;
  const double tilt = rotation->tilt();
  const bool was = robot.isFallen.value_or(false);
  setFallen(robot, was ? tilt > uprightTilt : tilt > fallenTilt, time);
}

TopicRobot* TopicRobots::replying(const telemetry::RobotReply& reply, const Game& game) {
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
  TopicRobot& robot = add(made);
  robot.nameInMapping.reset();
  robot.teamNumber = reply.team;
  robot.source = "referee's log";
  return &robot;
}

void TopicRobots::take(const telemetry::RobotReply& reply, const Game& game, double time) {
  constexpr double metres = 0.001;
  TopicRobot* robot = replying(reply, game);
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
    robot->pose =
        robot->onField({{static_cast<double>(x) * metres, static_cast<double>(y) * metres},
                        static_cast<double>(yaw)},
                       MappedFrame::Centre, m_options.field);
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

void TopicRobots::write(TopicRobot& robot, double time) {
  identify(robot);
  if (!robot.group) robot.group = m_rows.addGroup(robot.groupInfo(m_options.timeout));
  time = std::max(time, robot.lastTime);
  robot.fillRow(time, m_options.field);
  m_rows.append(*robot.group, {time, {}, robot.row});
  robot.lastTime = time;
  ++robot.rows;
}

std::vector<RobotFrame> TopicRobots::frames(double time, const std::optional<Game>& game) const {
  std::vector<RobotFrame> frames;
  for (const auto& robot : m_robots) {
    if (robot->rows == 0) continue;
    frames.push_back(robot->frame(time, m_options.timeout, m_options.field, game));
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
  std::vector<const TopicRobot*> seen;
  for (const auto& robot : m_robots) {
    if (robot->rows > 0) seen.push_back(robot.get());
  }
  std::ranges::stable_sort(seen, {}, [](const TopicRobot* robot) {
    return std::pair(robot->mapped.team, robot->mapped.number);
  });
  std::vector<std::string> names;
  for (const TopicRobot* robot : seen) names.push_back(robot->name);
  return names;
}

std::uint64_t TopicRobots::variables() const {
  return names().size() * topicRobotColumns;
}

void TopicRobots::addNotes(std::vector<std::string>& notes) const {
  for (const auto& robot : m_robots) {
    if (robot->rows > 0) continue;
    notes.push_back("Robot " + robot->plainName() +
                    ": no message has the values that the mapping names for it.");
  }
  if (m_refused > 0) {
    notes.push_back(std::to_string(m_refused) +
                    " replies of robots are of a team that does not play, or of too many robots.");
  }
}

}  // namespace pitchboard::link
