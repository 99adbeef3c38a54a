// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_teams.h>

#include <algorithm>
#include <charconv>

#include <robotlink/blackboard/variable_meanings.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/models/robot_models.h>

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
  made.teamBatteries.clear();
  for (std::size_t i = 0; i < options.team.teams.size(); ++i) {
    const std::string& name = options.team.teams[i].model;
    if (name.empty()) continue;
    // validate() has refused unknown models. A recording may name a file of another computer.
    const auto model = loadRobotModel(name);
    if (model) made.teamBatteries[static_cast<int>(i) + 1] = batteryLimitsOf(*model);
  }
  return made;
}

Result<void> chooseOurTeam(LiveOptions& options, std::string_view text) {
  constexpr int maxNumber = 65535;
  options.ourColour = teamColorNamed(text);
  options.ourTeam = 0;
  if (options.ourColour) return {};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, options.ourTeam);
  if (read.ec == std::errc() && read.ptr == end && options.ourTeam >= 0 &&
      options.ourTeam <= maxNumber) {
    return {};
  }
  return failure(ErrorCode::InvalidArgument,
                 "Our team is a number from 0 to 65535 or a colour such as blue or red.",
                 "\"" + std::string(text.substr(0, 40)) + "\"");
}

int ourNumber(const LiveOptions& options, const std::optional<Game>& game) {
  if (options.ourTeam != 0 || !options.ourColour || !game) return options.ourTeam;
  for (const GameTeam& team : game->teams) {
    if (team.colour == options.ourColour) return team.number;
  }
  return 0;
}

Teams teamsOf(const LiveOptions& options, const std::optional<Game>& game) {
  const auto colourFromReferee = [&game](int number) -> std::optional<TeamColor> {
    const int team = game && number > 0 ? game->teamNumbered(number) : Game::noTeam;
    if (team == Game::noTeam) return {};
    return robotColor(game->teams[static_cast<std::size_t>(team)].colour);
  };
  const std::vector<TeamSetup>& setups = options.team.teams;
  const int chosen = ourNumber(options, game);
  // The team that was chosen, else the first one.
  auto ours = setups.end();
  if (chosen != 0) ours = std::ranges::find(setups, chosen, &TeamSetup::number);
  if (ours == setups.end() && options.ourColour) {
    ours = std::ranges::find(setups, options.ourColour,
                             [](const TeamSetup& setup) { return teamColorNamed(setup.colour); });
  }
  if (ours == setups.end()) ours = setups.begin();
  Teams teams(1);
  if (setups.empty()) teams[0] = {chosen, {}, colourFromReferee(chosen), true};
  for (auto setup = setups.begin(); setup != setups.end(); ++setup) {
    const bool isOurs = setup == ours;
    const int number = setup->number > 0 || !isOurs ? setup->number : chosen;
    const auto colour = teamColorNamed(setup->colour);
    teams.push_back({number, setup->name, colour ? colour : colourFromReferee(number), isOurs});
  }
  Team& our = *std::ranges::find(teams, true, &Team::ours);
  if (!our.colour) our.colour = options.ourColour;
  return teams;
}

TeamColor drawnColour(const LiveOptions& options, const RobotKey& robot, const Teams& teams) {
  if (options.colourByNumber) {
    return teamColors[static_cast<std::size_t>(robot.number - 1) % teamColors.size()].color;
  }
  if (const auto known = colourAt(robot.team, teams)) return *known;
  // Two teams are two colours.
  const auto ours = std::ranges::find(teams, true, &Team::ours);
  const auto first = static_cast<std::size_t>(ours->colour.value_or(TeamColor::Blue));
  const auto further = static_cast<std::size_t>(std::max(robot.team - 1, 0));
  return teamColors[(first + further) % teamColors.size()].color;
}

std::string ownNameOf(const LiveOptions& options, const RobotKey& robot) {
  const TeamSetup* setup = setupOf(options, robot);
  if (setup == nullptr) return {};
  const auto found = setup->robots.find(robot.number);
  return found == setup->robots.end() ? std::string() : found->second;
}

LiveRowsOptions rowsOptions(const LiveOptions& options, Teams teams, telemetry::WallTime zero,
                            std::map<RobotUid, std::string> boards) {
  LiveRowsOptions made{zero, std::move(teams), {}, std::move(boards)};
  made.describe = [options](const RobotKey& robot, telemetry::RobotFacts& facts) {
    const TeamSetup* setup = setupOf(options, robot);
    facts.profile = setup != nullptr ? setup->profile.name : options.profile.name;
    if (setup == nullptr) return;
    facts.teamName = setup->title();
    facts.name = ownNameOf(options, robot);
  };
  return made;
}

}  // namespace pitchboard::link
