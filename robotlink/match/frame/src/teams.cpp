// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/teams.h>

#include <algorithm>

#include <telemetry/monitor/team_setup.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view unknownTeam = "Robot ";

}  // namespace

std::optional<TeamColor> colourAt(int place, const Teams& teams) {
  const auto index = static_cast<std::size_t>(place);
  return index < teams.size() ? teams[index].colour : std::nullopt;
}

std::string_view teamName(int number, const Teams& teams) {
  const auto found = std::ranges::find(teams, number, &Team::number);
  return number == 0 || found == teams.end() ? std::string_view() : std::string_view(found->name);
}

RobotOrder orderOf(const RobotKey& robot, const Teams& teams) {
  const auto place = static_cast<std::size_t>(robot.team);
  return {place >= teams.size() || !teams[place].ours, robot};
}

void fillTeams(const std::vector<sim::TeamSettings>& settings, Teams& teams) {
  teams = teamsByColour();
  for (const sim::TeamSettings& from : settings) {
    Team& team = teams[static_cast<std::size_t>(teamIndex(from.colour))];
    team.name = from.name;
    team.number = from.number;
  }
}

const Teams& teamsByColour() {
  static const Teams all = [] {
    Teams made(1);
    for (const TeamColorInfo& team : teamColors) made.push_back({0, {}, team.color, false});
    return made;
  }();
  return all;
}

RobotUid uidOf(const RobotKey& robot) {
  constexpr std::uint32_t known = 0x8000'0000;
  return {known | static_cast<std::uint32_t>(robot.team & 0x3f) << 25 |
          static_cast<std::uint32_t>(robot.sender & 0x1ff) << 16 |
          static_cast<std::uint32_t>(robot.number & 0xffff)};
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
  if (robot.team == telemetry::simulatedTeam) return "Simulated " + behind;
  const auto colour = colourAt(robot.team, teams);
  const bool isThere = static_cast<std::size_t>(robot.team) < teams.size();
  for (int earlier = colour ? 0 : 1; isThere && earlier < robot.team; ++earlier) {
    if (colourAt(earlier, teams) != colour) continue;
    const Team& team = teams[static_cast<std::size_t>(robot.team)];
    if (!team.name.empty()) return team.name + " " + behind;
    return "Team " + std::to_string(team.number > 0 ? team.number : robot.team) + " " + behind;
  }
  return (colour ? std::string(info(*colour).letter) : std::string(unknownTeam)) + behind;
}

}  // namespace pitchboard::link
