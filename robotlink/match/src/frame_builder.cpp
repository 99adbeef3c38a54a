// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame_builder.h"

#include <algorithm>
#include <utility>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/working_flags.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/referee_packet.h>

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::duration<double> workingAfter(flagMemory);
constexpr auto thoughtsInterval = 100ms;
constexpr auto speedWindow = 1s;

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
  out.teams = teamsByColour();
  takeProcesses(match.processes());
  for (std::size_t i = 0; i < state.robots.size(); ++i) {
    RobotFrame& robot = out.robots[i];
    static_cast<sim::RobotSnapshot&>(robot) = m_snapshot.robots[i];
    robot.key = keyOf(robot.identity);
    robot.name = robot.identity.name();
    fillBoard(match, state.robots[i], now, still, robot.board.emplace());
    const auto processes = m_processes.find(robot.slot());
    robot.processList = processes == m_processes.end() ? nullptr : processes->second;
    robot.thoughts.reset();
    robot.runtime = runtimeChoiceToText(match.runtime(robot.slot()));
    robot.ofOthers = false;
  }
  for (const sim::RobotIdentity& other : match.robotsOfOthers()) {
    out.robots[*simulation.indexOf(other.id)].ofOthers = true;
  }
  const auto number = match.number();
  out.matchNumber = number ? std::optional(number->value) : std::nullopt;
  out.inLockStep = match.inLockStep();
  out.slowestOwnProgram = match.slowestOwnProgram();
  std::erase_if(m_lastSeen, [&](const auto& entry) { return !simulation.indexOf(entry.first); });
  if (still || now - m_thoughtsTime >= thoughtsInterval) {
    m_thoughts = match.thoughts();
    m_thoughtsTime = now;
  }
  for (const RobotThoughts& thoughts : m_thoughts) {
    if (const auto index = simulation.indexOf(thoughts.robot)) {
      out.robots[*index].thoughts = thoughts;
    }
  }
  out.drawings.clear();
  out.drawingProblem.clear();
  if (const MatchDrawings* drawings = match.drawings()) {
    out.drawings = drawings->book().at(m_snapshot.time);
    keyDrawings(out);
    out.drawingProblem = drawings->problem();
  }
  showReferee(state, out);
  out.refereeRules = state.game ? state.settings.referee->name : std::string();
  out.finishedBy = match.finishedBy();
  out.finished = !out.finishedBy.empty();
  out.field = state.settings.field;
  out.noise = state.settings.noise;
  out.physics = state.settings.physics;
  out.seed = state.settings.seed;
  out.tickRate = state.settings.tickRate;
  fillSpeed(match, now, still, out);
}

/// Copied when something changed; the frames of a second share one copy.
void FrameBuilder::takeProcesses(const ProcessManager& processes) {
  if (std::exchange(m_processVersion, processes.version()) == processes.version()) return;
  std::map<RobotId, std::vector<ProcessStatus>> byRobot;
  for (const ProcessStatus& one : processes.statuses()) byRobot[one.robot].push_back(one);
  m_processes.clear();
  for (auto& [robot, list] : byRobot) {
    m_processes[robot] = std::make_shared<const std::vector<ProcessStatus>>(std::move(list));
  }
}

void FrameBuilder::fillBoard(const SimulatedMatch& match, const sim::RobotIdentity& robot, Time now,
                             bool still, RobotBoardView& out) {
  const Blackboard* board = match.blackboard(robot.id);
  if (!board) return;
  const RobotVariables& v = match.variables();
  out.key = board->key();
  out.behaviour = match.behaviour(robot.id);
  out.actionA = readOr(*board, v.decisionActionA);
  out.voltage = readOr(*board, v.voltage);
  out.visionLost = readOr(*board, v.visionLost) != 0;
  out.ballDistCm = readOr(*board, v.visionBallDist);
  out.panDeg = readOr(*board, v.visionPanDeg);
  out.localizationX = readOr(*board, v.localizationX);
  out.localizationY = readOr(*board, v.localizationY);
  out.localizationTheta = readOr(*board, v.localizationTheta);
  out.belief = readOr(*board, v.localizationBelief);

  struct Flag {
    IntVar variable;
    bool RobotBoardView::*working;
    bool simulated;
  };
  const std::array<Flag, flags> all{
      {{v.controlWorking, &RobotBoardView::controlWorking, true},
       {v.visionWorking, &RobotBoardView::visionWorking, true},
       {v.imuWorking, &RobotBoardView::imuWorking, true},
       {v.localizationWorking, &RobotBoardView::localizationWorking, false},
       {v.decisionWorking, &RobotBoardView::decisionWorking, false}}};
  const auto [entry, isNew] = m_lastSeen.try_emplace(robot.id);
  if (isNew) entry->second.fill(Time::min());
  for (std::size_t i = 0; i < flags; ++i) {
    Time& seen = entry->second[i];
    const bool wasWorking = seen != Time::min() && now - seen <= workingAfter;
    const bool heldUp = still && all[i].simulated && wasWorking;
    if (readOr(*board, all[i].variable) != 0 || heldUp) seen = now;
    out.*all[i].working = seen != Time::min() && now - seen <= workingAfter;
  }
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
  out.speed = out.ticksPerSecond / out.tickRate;
  if (ticks > 0) out.tickMicroseconds = (m_busy - first.busy) / ticks * 1e6;
}

}  // namespace pitchboard::link
