// SPDX-License-Identifier: GPL-3.0-or-later
// The messages of ROS whose meaning is known: geometry_msgs/PoseWithCovarianceStamped,
// nav_msgs/Odometry, tf2_msgs/TFMessage, sensor_msgs/BatteryState, sensor_msgs/Imu, and the logs of
// ROS 2 and ROS 1. Joint states need no mapping: their values have the names of the joints.
#include <robotlink/live/topic_mapping.h>

#include <algorithm>
#include <charconv>
#include <map>

namespace pitchboard::link {
namespace {

using telemetry::RecordedTopic;

constexpr int localizedPose = 4, anyPose = 3, odometryPose = 1;

/// "/robot1" of "/robot1/amcl_pose"; empty for "/amcl_pose".
std::string namespaceOf(const std::string& topic) {
  const auto begin = topic.starts_with('/') ? std::size_t{1} : std::size_t{0};
  const auto end = topic.find('/', begin);
  return end == topic.npos ? std::string() : topic.substr(0, end);
}

bool nameContains(const std::string& topic, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(
      parts, [&topic](std::string_view part) { return topic.find(part) != topic.npos; });
}

class BuiltIn {
 public:
  TopicMapping make(std::span<const RecordedTopic> topics) {
    for (const RecordedTopic& topic : topics) {
      if (topic.isUnderstood()) take(topic);
    }
    numberRobots();
    return std::move(m_mapping);
  }

 private:
  MappedRobot& robotOf(const RecordedTopic& topic) {
    std::string space = namespaceOf(topic.name);
    // "/imu/data" is not of a robot called imu.
    if (space == "/imu" || space == "/localization" || space == "/odometry") space.clear();
    return m_robots[space];
  }

  void take(const RecordedTopic& topic) {
    const std::string& name = topic.name;
    if (topic.type == "geometry_msgs/PoseWithCovarianceStamped") {
      // What a person sets in RViz is not where the robot is.
      if (nameContains(name, {"initialpose", "goal"})) return;
      const bool isLocalized = nameContains(name, {"amcl", "locali"});
      takePose(topic, isLocalized ? localizedPose : anyPose);
    } else if (topic.type == "nav_msgs/Odometry") {
      takePose(topic, odometryPose);
    } else if (topic.type == "tf2_msgs/TFMessage" || topic.type == "tf/tfMessage") {
      // Transforms that never change are of the same tree.
      if (!nameContains(name, {"tf_static"})) robotOf(topic).transforms = {name, {}, {}, {}};
    } else if (topic.type == "sensor_msgs/BatteryState") {
      robotOf(topic).battery = {name, "voltage", "percentage", "V", {}, {}, {}};
    } else if (topic.type == "sensor_msgs/Imu") {
      robotOf(topic).fallen = {name, "orientation", {}};
    } else if (topic.type == "rcl_interfaces/Log" || topic.type == "rosgraph_msgs/Log") {
      // ROS 1 passes every line on once more.
      if (!nameContains(name, {"rosout_agg"}))
        m_mapping.log.push_back({name, "msg", "level", "name"});
    }
  }

  void takePose(const RecordedTopic& topic, int priority) {
    MappedPose pose;
    pose.topic = topic.name;
    pose.x = "pose.pose.position.x";
    pose.y = "pose.pose.position.y";
    pose.orientation = "pose.pose.orientation";
    pose.covariance = "pose.covariance";
    pose.priority = priority;
    robotOf(topic).poses.push_back(std::move(pose));
  }

  /// A robot has a pose or a battery.
  void numberRobots() {
    std::erase_if(m_robots, [](const auto& entry) {
      const MappedRobot& robot = entry.second;
      return robot.poses.empty() && !robot.transforms && !robot.battery;
    });
    std::vector<int> taken;
    for (auto& [space, robot] : m_robots) {
      const int number = numberOfName(space).value_or(0);
      if (number == 0 || std::ranges::count(taken, number) > 0) continue;
      robot.number = number;
      taken.push_back(number);
    }
    int next = 1;
    for (auto& [space, robot] : m_robots) {
      while (robot.number == 0 && std::ranges::count(taken, next) > 0) ++next;
      if (robot.number == 0) taken.push_back(robot.number = next);
      robot.name = space.empty() ? std::string() : space.substr(space.starts_with('/') ? 1 : 0);
      m_mapping.robots.push_back(std::move(robot));
    }
    std::ranges::stable_sort(m_mapping.robots, {}, &MappedRobot::number);
  }

  std::map<std::string, MappedRobot> m_robots;  ///< by namespace
  TopicMapping m_mapping;
};

}  // namespace

std::optional<int> numberOfName(const std::string& name) {
  auto begin = name.size();
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  int number = 0;
  const auto read = std::from_chars(name.data() + begin, name.data() + name.size(), number);
  if (read.ec != std::errc() || number < 1 || number > 99) return {};
  return number;
}

TopicMapping builtInMapping(std::span<const RecordedTopic> topics) {
  return BuiltIn().make(topics);
}

}  // namespace pitchboard::link
