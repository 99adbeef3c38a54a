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

const Team* teamAt(int place, const Teams& teams) {
  const auto index = static_cast<std::size_t>(place) - 1;
  return place > 0 && index < teams.size() ? &teams[index] : nullptr;
}

}  // namespace

const Teams& teamsByColour() {
  static const Teams all = [] {
    Teams made;
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
  RobotKey key{0, number % teamStep, isAttached ? attachedSender : (id - 1) / senderStep};
  if (hasTeams) key.team = number / teamStep + 1;
  return key;
}

std::string robotName(const RobotKey& robot, const Teams& teams) {
  const std::string number = std::to_string(robot.number);
  const std::string behind =
      robot.sender > 0 ? number + " (" + std::to_string(robot.sender + 1) + ")" : number;
  const Team* team = teamAt(robot.team, teams);
  if (team == nullptr || !team->colour) return std::string(unknownTeam) + behind;
  const bool isFirst =
      std::none_of(teams.data(), team, [&](const Team& t) { return t.colour == team->colour; });
  if (isFirst) return std::string(info(*team->colour).letter) + behind;
  return (team->name.empty() ? "Team " + std::to_string(robot.team) : team->name) + " " + behind;
}

std::optional<RobotKey> robotNamed(std::string_view name, const Teams& teams,
                                   std::span<const RobotKey> known) {
  const auto exact = std::ranges::find_if(
      known, [&](const RobotKey& robot) { return robotName(robot, teams) == name; });
  if (exact != known.end()) return *exact;
  const auto wanted = partsOf(name);
  if (!wanted) return std::nullopt;
  std::optional<RobotKey> only;
  for (const RobotKey& robot : known) {
    if (robot.number != wanted->number || robot.sender != wanted->sender) continue;
    const Team* team = teamAt(robot.team, teams);
    const bool isKnown = team != nullptr && team->colour;
    if (wanted->colour && isKnown) continue;
    if (only) return std::nullopt;
    only = robot;
  }
  return only;
}

}  // namespace pitchboard::link
