// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame_builder.h"

#include <algorithm>
#include <utility>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/referee_packet.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using telemetry::FieldMeaning;

constexpr auto debugInterval = 100ms;
constexpr auto speedWindow = 1s;

std::optional<double> valueOf(const Variable* variable, const Blackboard& board) {
  if (variable == nullptr) return std::nullopt;
  return variable->type == VariableType::Int
             ? board.read(IntVar{variable->index})
             : static_cast<double>(board.read(FloatVar{variable->index}));
}

}  // namespace

void FrameBuilder::addBusy(std::chrono::steady_clock::duration busy, std::uint64_t ticks) {
  m_busy += std::chrono::duration<double>(busy).count();
  m_ticksDone += ticks;
}

void FrameBuilder::resetSpeed(Time now, std::uint64_t tick) {
  m_samples.clear();
  m_samples.push_back({now, tick, m_ticksDone, m_busy});
}

void FrameBuilder::fill(SimulatedMatch& match, Time now, bool still, MatchFrame& out) {
  const sim::Simulation& simulation = match.simulation();
  simulation.snapshot(m_snapshot);
  const sim::WorldState& state = simulation.state();
  out.snapshot = m_snapshot;
  out.robots.resize(state.robots.size());
  fillTeams(state.settings.teams, out.teams);
  takeProcesses(match.robots());
  if (!still && m_last != Time{}) m_playing += std::chrono::duration<double>(now - m_last).count();
  m_last = now;
  for (std::size_t i = 0; i < state.robots.size(); ++i) {
    RobotFrame& robot = out.robots[i];
    static_cast<sim::RobotSnapshot&>(robot) = m_snapshot.robots[i];
    robot.uid = uidOf(robot.identity.id);
    robot.key = keyOf(robot.identity);
    robot.name = robot.identity.name();
    const auto processes = m_processes.find(robot.slot());
    robot.processList = processes == m_processes.end() ? nullptr : processes->second;
    fillRobot(match, robot);
    robot.cognitionDebug.reset();
    robot.runtime = runtimeChoiceToText(match.robots().find(robot.slot())->choice);
    robot.ofOthers = false;
  }
  for (const sim::RobotIdentity& other : match.robots().ofOthers()) {
    out.robots[*simulation.indexOf(other.id)].ofOthers = true;
  }
  const auto& claim = match.robots().claim();
  out.matchNumber = claim ? std::optional(claim->number().value) : std::nullopt;
  out.inLockStep = match.pace().waitsForProcesses();
  out.slowestTeamProgram = match.pace().slowestTeamProgram();
  const ProcessPace::Wait* wait = still ? nullptr : match.pace().waitedFor(now);
  const auto late = wait != nullptr ? simulation.indexOf(wait->robot) : std::nullopt;
  out.waitsFor = late ? out.robots[*late].name + " " + wait->process : std::string();
  std::erase_if(m_lamps, [&](const auto& entry) { return !simulation.indexOf(entry.first); });
  if (still || now - m_debugTime >= debugInterval) {
    m_cognitionDebug = match.cognitionDebug();
    m_debugTime = now;
  }
  for (const CognitionDebug& cognitionDebug : m_cognitionDebug) {
    if (const auto index = simulation.indexOf(cognitionDebug.robot)) {
      out.robots[*index].cognitionDebug = cognitionDebug;
    }
  }
  out.drawings.clear();
  out.drawingProblem.clear();
  if (const MatchDrawings* drawings = match.drawings()) {
    out.drawings = drawings->store().at(m_snapshot.time);
    keyDrawings(out);
    out.drawingProblem = drawings->problem();
  }
  showReferee(state.game, state.settings.referee, out);
  out.finishedBy = match.finishedBy();
  out.finished = !out.finishedBy.empty();
  out.nobodyPlays = match.nobodyPlays();
  out.settings = settingsOf(state);
  fillSpeed(match, now, still, out);
}

/// A new one when something changed; the frames of a match share it.
std::shared_ptr<const FrameSettings> FrameBuilder::settingsOf(const sim::WorldState& state) {
  const sim::SimulationSettings& now = state.settings;
  const FrameSettings& kept = *m_settings;
  if (kept.field != now.field || kept.noise != now.noise || kept.physics != now.physics ||
      kept.seed != now.seed || kept.tickRate != now.tickRate || kept.rigidBody != now.rigidBody) {
    m_settings = std::make_shared<const FrameSettings>(
        FrameSettings{now.field, now.noise, now.physics, now.seed, now.tickRate, now.rigidBody});
  }
  return m_settings;
}

/// Copied when something changed; the frames of a second share one copy.
void FrameBuilder::takeProcesses(const RobotSlots& robots) {
  const ProcessManager& processes = robots.processes();
  if (std::exchange(m_processVersion, processes.version()) == processes.version()) return;
  std::map<RobotId, std::vector<ProcessStatus>> byRobot;
  for (const ProcessStatus& one : processes.statuses()) {
    byRobot[one.robot].push_back(one);
  }
  // In the order of the robot's runtime profile, whichever was started last.
  std::map<int, std::size_t> places;
  for (const auto& slot : robots.all()) {
    for (std::size_t i = 0; i < slot->processes.size(); ++i) places[slot->processes[i]->id] = i;
  }
  m_processes.clear();
  for (auto& [robot, list] : byRobot) {
    std::ranges::stable_sort(list, {}, [&places](const auto& one) { return places[one.id]; });
    m_processes[robot] = std::make_shared<const std::vector<ProcessStatus>>(std::move(list));
  }
}

void FrameBuilder::fillRobot(const SimulatedMatch& match, RobotFrame& out) {
  const Blackboard* board = match.blackboard(out.slot());
  if (!board) return;
  if (std::exchange(m_catalog, &match.catalog()) != &match.catalog()) {
    for (std::size_t i = 0; i < m_variables.size(); ++i) {
      const std::string_view name = telemetry::meaningTable[i].variable;
      m_variables[i] = name.empty() ? nullptr : m_catalog->find(name);
    }
  }
  const RobotReader reader = [&](FieldMeaning meaning) -> std::optional<double> {
    const auto value = valueOf(m_variables[static_cast<std::size_t>(meaning)], *board);
    return value ? std::optional(meantBy(meaning, *value)) : std::nullopt;
  };
  out.boardKey = board->key();
  const RobotSlot& slot = *match.robots().find(out.slot());
  out.behaviour = slot.behaviour;
  out.programs = slot.programs;
  out.lamps = m_lamps[out.slot()].note(reader, m_playing);
  buildRobot(reader, match.simulation().state().settings.field,
             batteryLimitsOf(*match.robots().model(out.slot())), true, out);
}

void FrameBuilder::fillSpeed(const SimulatedMatch& match, Time now, bool still, MatchFrame& out) {
  const std::uint64_t tick = match.simulation().state().tick;
  if (!m_samples.empty() && tick < m_samples.back().tick) m_samples.clear();  // a moment put back
  m_samples.push_back({now, tick, m_ticksDone, m_busy});
  while (m_samples.size() > 2 && now - m_samples[1].time >= speedWindow) m_samples.pop_front();
  const Sample& first = m_samples.front();
  const double wall = std::chrono::duration<double>(now - first.time).count();
  const double ticks = static_cast<double>(m_ticksDone - first.ticksDone);
  out.ticksPerSecond = !still && wall > 0 ? ticks / wall : 0.0;
  out.speed = out.ticksPerSecond / out.settings->tickRate;
  if (ticks > 0) out.tickMicroseconds = (m_busy - first.busy) / ticks * 1e6;
}

}  // namespace pitchboard::link
