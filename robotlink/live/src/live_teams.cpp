// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_teams.h>

#include <algorithm>

#include <robotlink/blackboard/variable_meanings.h>
#include <telemetry/wire/gamecontroller.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using telemetry::TeamSetup;

const TeamSetup* setupOf(const LiveOptions& options, const RobotKey& robot) {
  return telemetry::setupAt(robot.team, options.team.teams);
}

}  // namespace

telemetry::Surroundings surroundingsOf(const sim::FieldSpec& field) {
  telemetry::Surroundings where;
  where.length = field.length;
  where.width = field.width;
  where.unitOf = [](const std::string& variable) {
    telemetry::ColumnInfo column;
    column.name = variable;
    VariableMeanings::published().describe(column);
    return column.unit;
  };
  return where;
}

telemetry::MonitorOptions monitorOptions(const LiveOptions& options) {
  telemetry::MonitorOptions made = options.team;
  made.field = surroundingsOf(options.field);
  return made;
}

Teams teamsOf(const LiveOptions& options, const telemetry::RefereeState* referee) {
  const auto toldOf = [referee](int number) -> std::optional<TeamColor> {
    const auto* team = referee != nullptr && number > 0 ? referee->team(number) : nullptr;
    return team == nullptr ? std::nullopt : teamColour(telemetry::colourWords(team->colour));
  };
  const std::vector<TeamSetup>& setups = options.team.teams;
  Teams teams(1);
  if (setups.empty()) teams[0] = {options.ourTeam, {}, toldOf(options.ourTeam), true};
  for (const TeamSetup& setup : setups) {
    const bool ours = teams.size() == 1;
    const int number = setup.number > 0 || !ours ? setup.number : options.ourTeam;
    teams.push_back({number, setup.title(), setup.colour ? setup.colour : toldOf(number), ours});
  }
  return teams;
}

TeamColor drawnColour(const LiveOptions& options, const RobotKey& robot, const Teams& teams) {
  if (options.colourByNumber) {
    return teamColors[static_cast<std::size_t>(robot.number - 1) % teamColors.size()].color;
  }
  if (const auto known = colourAt(robot.team, teams)) return *known;
  // Two teams are two colours.
  const auto ours = std::ranges::find(teams, true, &Team::ours);
  const auto first = static_cast<std::size_t>(ours->colour.value_or(options.colour));
  const auto further = static_cast<std::size_t>(std::max(robot.team - 1, 0));
  return teamColors[(first + further) % teamColors.size()].color;
}

std::string ownNameOf(const LiveOptions& options, const RobotKey& robot) {
  const TeamSetup* setup = setupOf(options, robot);
  if (setup == nullptr) return {};
  const auto found = setup->robots.find(robot.number);
  return found == setup->robots.end() ? std::string() : found->second;
}

telemetry::LiveRowsOptions rowsOptions(const LiveOptions& options, Teams teams,
                                       telemetry::WallTime zero,
                                       std::map<RobotKey, std::string> boards) {
  telemetry::LiveRowsOptions made{zero, std::move(teams), {}, std::move(boards)};
  made.attributes = [options](const RobotKey& robot) {
    const TeamSetup* setup = setupOf(options, robot);
    std::map<std::string, std::string> more{
        {"profile", setup != nullptr ? setup->profile.name : options.profile.name}};
    if (setup == nullptr) return more;
    more["team_name"] = setup->title();
    if (const std::string own = ownNameOf(options, robot); !own.empty()) more["name"] = own;
    return more;
  };
  return made;
}

}  // namespace pitchboard::link
