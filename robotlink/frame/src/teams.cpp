// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/teams.h>

#include <algorithm>
#include <charconv>

namespace pitchboard::link {
namespace {

constexpr std::string_view unknownTeam = "Robot ";

struct NameParts {
  int number = 0, sender = 0;
  std::optional<TeamColor> colour;  // nothing: the name does not say it
};

/// Of "Robot 3", "B3" and "B3 (2)".
std::optional<NameParts> partsOf(std::string_view name) {
  NameParts parts;
  if (name.starts_with(unknownTeam)) {
    name.remove_prefix(unknownTeam.size());
  } else {
    const auto letter = std::ranges::find(teamColors, name.substr(0, 1), &TeamColorInfo::letter);
    if (letter == teamColors.end()) return std::nullopt;
    parts.colour = letter->color;
    name.remove_prefix(1);
  }
  const char* const end = name.data() + name.size();
  auto read = std::from_chars(name.data(), end, parts.number);
  if (read.ec != std::errc() || parts.number <= 0) return std::nullopt;
  if (read.ptr == end) return parts;
  const std::string_view more(read.ptr, static_cast<std::size_t>(end - read.ptr));
  if (!more.starts_with(" (") || !more.ends_with(')')) return std::nullopt;
  read = std::from_chars(read.ptr + 2, end - 1, parts.sender);
  if (read.ec != std::errc() || read.ptr != end - 1 || parts.sender < 2) return std::nullopt;
  --parts.sender;
  return parts;
}

}  // namespace

std::optional<TeamColor> colourAt(int place, const Teams& teams) {
  const auto index = static_cast<std::size_t>(place);
  return index < teams.size() ? teams[index].colour : std::nullopt;
}

const Teams& teamsByColour() {
  static const Teams all = [] {
    Teams made(1);
    for (const TeamColorInfo& team : teamColors) made.push_back({0, {}, team.color, false});
    return made;
  }();
  return all;
}

RobotKey keyOfOldId(int id, bool hasTeams) {
  constexpr int senderStep = 65536, attachedStep = senderStep * 1000, teamStep = 1000;
  if (id <= 0) return {};
  const bool isAttached = id > attachedStep;
  const int number = (id - 1) % senderStep + 1;
  RobotKey key{0, number % teamStep, isAttached ? 0 : (id - 1) / senderStep};
  if (hasTeams) key.team = number / teamStep + 1;
  return key;
}

std::string robotName(const RobotKey& robot, const Teams& teams) {
  const std::string number = std::to_string(robot.number);
  const std::string behind =
      robot.sender > 0 ? number + " (" + std::to_string(robot.sender + 1) + ")" : number;
  const auto colour = colourAt(robot.team, teams);
  const bool isThere = static_cast<std::size_t>(robot.team) < teams.size();
  for (int earlier = colour ? 0 : 1; isThere && earlier < robot.team; ++earlier) {
    if (colourAt(earlier, teams) != colour) continue;
    const std::string& title = teams[static_cast<std::size_t>(robot.team)].name;
    return (title.empty() ? "Team " + std::to_string(robot.team) : title) + " " + behind;
  }
  return (colour ? std::string(info(*colour).letter) : std::string(unknownTeam)) + behind;
}

bool isSameRobot(std::string_view name, std::string_view other) {
  if (name == other) return true;
  const auto a = partsOf(name), b = partsOf(other);
  return a && b && a->number == b->number && a->sender == b->sender &&
         a->colour.has_value() != b->colour.has_value();
}

std::optional<std::string> robotNamed(std::string_view name, std::span<const std::string> known) {
  std::vector<std::string> fitting;
  for (const std::string& robot : known) {
    if (robot == name) return robot;
    if (isSameRobot(name, robot)) fitting.push_back(robot);
  }
  return fitting.size() == 1 ? std::optional(fitting.front()) : std::nullopt;
}

}  // namespace pitchboard::link
