// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/group_order.h>

#include <array>
#include <charconv>

namespace pitchboard::telemetry {
namespace {
const std::string orderAttribute = "order";
}  // namespace

void setOrder(GroupInfo& group, const RobotOrder& order) {
  const RobotKey& robot = order.robot;
  group.attributes[orderAttribute] =
      std::to_string(order.isTheirs ? 1 : 0) + " " + std::to_string(robot.team) + " " +
      std::to_string(robot.number) + " " + std::to_string(robot.sender);
}

std::optional<RobotOrder> orderOf(const GroupInfo& group) {
  const auto written = group.attributes.find(orderAttribute);
  if (written == group.attributes.end()) return std::nullopt;
  std::array<int, 4> numbers{};
  const char* at = written->second.data();
  const char* const end = at + written->second.size();
  for (int& number : numbers) {
    if (at != end && *at == ' ') ++at;
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc()) return std::nullopt;
    at = read.ptr;
  }
  return RobotOrder{numbers[0] != 0, {numbers[1], numbers[2], numbers[3]}};
}

bool isListedBefore(const GroupInfo& group, const GroupInfo& other) {
  const auto a = orderOf(group), b = orderOf(other);
  return a != b ? a < b : a.has_value() && group.name < other.name;
}

}  // namespace pitchboard::telemetry
