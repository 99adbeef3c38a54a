// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/match_sampler.h>

#include <algorithm>

#include <base/angles.h>
#include <base/lined_json.h>
#include <robotlink/frame/teams.h>
#include <telemetry/series/group_order.h>

#include "match_columns.h"

namespace pitchboard::link {
namespace {

bool isAdvised(const SimulatedMatch& match) {
  return !match.scenario().advisors.empty();
}

/// Those of the map, and where a team thinks ahead what its advisors say.
std::vector<Variable> sampledVariables(const SimulatedMatch& match) {
  const auto own = match.catalog().variables();
  std::vector<Variable> out(own.begin(), own.end());
  if (!isAdvised(match)) return out;
  const VariableCatalog all = match.catalog().withExtension();
  for (const Variable& more : all.variables()) {
    if (more.name.starts_with("ADVISOR_") && !match.catalog().find(more.name)) out.push_back(more);
  }
  return out;
}

}  // namespace

MatchSampler::MatchSampler(std::shared_ptr<telemetry::RowSink> sink, MatchSamplerOptions options) {
  setEveryNth(options.everyNth);
  if (sink) m_outlets.push_back({std::move(sink), {}});
}

MatchSampler::~MatchSampler() = default;

void MatchSampler::ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) {
  const std::uint64_t tick = match.simulation().state().tick;
  // A moment without a tick (the first one, a change by hand) is always shown.
  const bool due = tickTime.count() == 0 || tick % std::uint64_t(m_options.everyNth) == 0;
  if (m_outlets.empty() || !due) return;
  look(match);
  sampleInto(m_outlets, match, tickTime);
}

void MatchSampler::add(std::shared_ptr<telemetry::RowSink> sink, const SimulatedMatch& match) {
  look(match);
  Outlet& outlet = m_outlets.emplace_back(Outlet{std::move(sink), {}});
  registerGroups(outlet);
  sampleInto({&outlet, 1}, match, {});
}

void MatchSampler::remove(const std::shared_ptr<telemetry::RowSink>& sink) {
  std::erase_if(m_outlets, [&](const Outlet& outlet) { return outlet.sink == sink; });
}

void MatchSampler::look(const SimulatedMatch& match) {
  match.simulation().snapshot(m_snapshot);
  if (sameRobots(match)) return;
  takeRobots(match);
  for (Outlet& outlet : m_outlets) registerGroups(outlet);
}

void MatchSampler::registerGroups(Outlet& outlet) const {
  outlet.groups.clear();
  for (const telemetry::GroupInfo& group : m_groups) {
    outlet.groups.push_back(outlet.sink->addGroup(group));
  }
}

void MatchSampler::sampleInto(std::span<const Outlet> outlets, const SimulatedMatch& match,
                              std::chrono::nanoseconds tickTime) {
  const auto append = [&](std::size_t group, const telemetry::RowView& row) {
    for (const Outlet& outlet : outlets) outlet.sink->append(outlet.groups[group], row);
  };
  readMatch(match.simulation().state(), m_snapshot,
            std::chrono::duration<double, std::micro>(tickTime).count(), m_matchValues);
  append(0, {m_snapshot.time, {}, m_matchValues});
  for (std::size_t i = 0; i < m_sampled.size(); ++i) {
    const sim::RobotSnapshot& robot = m_snapshot.robots[i];
    const Blackboard* board = match.blackboard(robot.identity.id);
    if (!board) continue;
    m_board->read(*board, m_words);
    readTruth(match, m_snapshot, robot, *board, m_truth);
    append(i + 1, {m_snapshot.time, m_words, m_truth});
  }
}

bool MatchSampler::sameRobots(const SimulatedMatch& match) const {
  if (m_catalog != &match.catalog() || m_advised != isAdvised(match)) return false;
  return std::ranges::equal(
      m_sampled, m_snapshot.robots, [&](const SampledRobot& sampled, const auto& robot) {
        const RobotSlot* slot = match.robots().find(robot.identity.id);
        return sampled.identity == robot.identity && slot && sampled.key == slot->board.key() &&
               sampled.behaviour == slot->behaviour && sampled.radius == robot.radius &&
               sampled.fieldOfView == robot.fieldOfView && sampled.visionRange == robot.visionRange;
      });
}

void MatchSampler::takeRobots(const SimulatedMatch& match) {
  if (m_catalog != &match.catalog() || m_advised != isAdvised(match)) {
    m_catalog = &match.catalog();
    m_advised = isAdvised(match);
    m_board = std::make_unique<BoardColumns>(sampledVariables(match));
  }
  const sim::SimulationSettings& settings = match.simulation().state().settings;
  telemetry::GroupInfo group{matchGroup, matchColumns(), {}};
  group.attributes = {{"physics", settings.physics},
                      {"seed", std::to_string(settings.seed)},
                      {"tick_rate", shortest(settings.tickRate)}};
  m_matchValues.resize(group.columns.size());
  m_groups.clear();
  m_groups.push_back(std::move(group));

  auto truth = truthColumns();
  // A team's own variable keeps its name.
  for (telemetry::ColumnInfo& column : truth) {
    while (std::ranges::find(m_board->columns(), column.name, &telemetry::ColumnInfo::name) !=
           m_board->columns().end()) {
      column.name.insert(0, "TRUTH_");
    }
  }
  m_words.resize(m_board->size());
  m_truth.resize(truth.size());
  m_sampled.clear();
  Teams teams;
  fillTeams(settings.teams, teams);
  for (const sim::RobotSnapshot& robot : m_snapshot.robots) {
    const sim::RobotIdentity& identity = robot.identity;
    const RobotSlot& slot = *match.robots().find(identity.id);
    SampledRobot sampled{identity,     slot.board.key(),  slot.behaviour,
                         robot.radius, robot.fieldOfView, robot.visionRange};
    telemetry::GroupInfo info{groupName(identity), m_board->columns(), {}};
    info.columns.insert(info.columns.end(), truth.begin(), truth.end());
    info.attributes = {{"robot", std::to_string(identity.id.value)},
                       {"team", std::string(pitchboard::info(identity.team).name)},
                       {"number", std::to_string(identity.number)},
                       {"key", std::to_string(sampled.key)},
                       {"imu180", identity.imuStartsAt180 ? "1" : "0"},
                       {"behaviour", sampled.behaviour},
                       {"radius", shortest(robot.radius)},
                       {"field_of_view", shortest(degreesFromRadians(robot.fieldOfView))},
                       {"vision_range", shortest(robot.visionRange)}};
    const sim::RobotModel& model = *match.robots().model(identity.id);
    for (const auto& [key, volts] : {std::pair("battery_full", model.batteryFull),
                                     {"battery_low", model.batteryLow},
                                     {"battery_empty", model.batteryEmpty}}) {
      info.attributes[key] = shortest(volts);
    }
    telemetry::setOrder(info, orderOf(keyOf(identity), teams));
    const std::string& team = teams[static_cast<std::size_t>(identity.team) + 1].name;
    if (!team.empty()) info.attributes["team_name"] = team;
    m_groups.push_back(std::move(info));
    m_sampled.push_back(std::move(sampled));
  }
}

std::string MatchSampler::groupName(const sim::RobotIdentity& robot) const {
  const std::string name = robot.name();
  // Two robots of a team may have one number by mistake; their rows must not mix.
  const bool taken = std::ranges::any_of(m_sampled, [&](const SampledRobot& sampled) {
    return sampled.identity.team == robot.team && sampled.identity.number == robot.number;
  });
  return taken ? name + " (" + std::to_string(robot.id.value) + ")" : name;
}

}  // namespace pitchboard::link
