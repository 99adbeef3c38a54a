// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_teams.h>

#include <algorithm>

#include <robotlink/blackboard/variable_meanings.h>

#include "live_frame.h"

namespace pitchboard::link {
namespace {

using telemetry::TeamSetup;

const TeamSetup* setupOf(const LiveOptions& options, const RobotKey& robot) {
  return telemetry::setupAt(robot.team, options.team.teams);
}

bool namesVariables(const telemetry::Profile& profile) {
  return std::any_of(profile.fields.begin(), profile.fields.end(),
                     [](const auto& field) { return !field.variable.empty(); });
}

std::string nameOf(const LiveOptions& options, const RobotKey& robot) {
  const auto& teams = options.team.teams;
  const int number = robot.number;
  if (robot.team == 0 && (!teams.empty() || !namesVariables(options.profile))) {
    return "Robot " + std::to_string(number);
  }
  sim::RobotIdentity identity;
  identity.team = colourOf(options, robot, options.colour, {});
  identity.number = number;
  // What its own blackboard on this computer says has the name, and more columns.
  const auto boards = boardNames(options.boards);
  if (std::ranges::find(boards, identity.name()) != boards.end()) {
    return identity.name() + " heard";
  }
  // Two teams of one colour would have one name.
  for (int other = 1; other < robot.team; ++other) {
    if (colourOf(options, {other, number, 0}, options.colour, {}) == identity.team) {
      return setupOf(options, robot)->title() + " " + std::to_string(number);
    }
  }
  return identity.name();
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

Teams teamsOf(const std::vector<TeamSetup>& setups) {
  Teams teams;
  for (const TeamSetup& setup : setups) {
    teams.push_back({setup.number, setup.title(), setup.colour, teams.empty()});
  }
  return teams;
}

TeamColor colourOf(const LiveOptions& options, const RobotKey& robot, TeamColor ours,
                   const std::optional<RefereeView>& referee) {
  if (options.colourByNumber) {
    return teamColors[static_cast<std::size_t>(robot.number - 1) % teamColors.size()].color;
  }
  const TeamSetup* setup = setupOf(options, robot);
  if (setup == nullptr) return ours;
  if (setup->colour) return *setup->colour;
  if (referee && setup->number > 0) {
    for (const RefereeTeamView& side : referee->teams) {
      if (side.number != setup->number) continue;
      if (const auto colour = teamColour(side.colour)) return *colour;
    }
  }
  // Two teams are two colours.
  const auto further = static_cast<std::size_t>(robot.team - 1);
  return teamColors[(static_cast<std::size_t>(ours) + further) % teamColors.size()].color;
}

int refereeNumberOf(const LiveOptions& options, const RobotKey& robot) {
  const TeamSetup* setup = setupOf(options, robot);
  return setup != nullptr && setup->number > 0 ? setup->number : options.ourTeam;
}

std::string ownNameOf(const LiveOptions& options, const RobotKey& robot) {
  const TeamSetup* setup = setupOf(options, robot);
  if (setup == nullptr) return {};
  const auto found = setup->robots.find(robot.number);
  return found == setup->robots.end() ? std::string() : found->second;
}

std::string meaningAttribute(telemetry::FieldMeaning meaning) {
  return "is_" + std::string(telemetry::meaningName(meaning));
}

telemetry::LiveRowsOptions rowsOptions(const LiveOptions& options, telemetry::WallTime zero) {
  telemetry::LiveRowsOptions made;
  made.zero = zero;
  made.name = [options](const RobotKey& robot) { return nameOf(options, robot); };
  if (options.team.teams.empty()) return made;
  made.attributes = [options](const RobotKey& robot) {
    std::map<std::string, std::string> more{
        {"shirt", std::to_string(robot.number)},
        {"team", std::string(info(colourOf(options, robot, options.colour, {})).name)}};
    if (const TeamSetup* setup = setupOf(options, robot)) {
      more["team_name"] = setup->title();
      more["profile"] = setup->profile.name;
      const telemetry::TextDecoder decoder(setup->profile, surroundingsOf(options.field));
      for (const telemetry::ProfileField& field : decoder.profile().fields) {
        if (field.meaning == telemetry::FieldMeaning::None) continue;
        more[meaningAttribute(field.meaning)] = field.name;
      }
    }
    if (const std::string own = ownNameOf(options, robot); !own.empty()) more["name"] = own;
    return more;
  };
  return made;
}

}  // namespace pitchboard::link
