// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/simulated_match.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <robotlink/match/match_drawings.h>

#include "match_events.h"
#include "match_referee.h"
#include "match_seat.h"

namespace pitchboard::link {
namespace {

// A time that is a whole number of ticks but for rounding belongs to that tick.
constexpr double tickTolerance = 1e-6;

std::uint64_t firstTickAtOrAfter(double seconds, double rate) {
  return static_cast<std::uint64_t>(std::max(0.0, std::ceil(seconds * rate - tickTolerance)));
}

}  // namespace

SimulatedMatch::SimulatedMatch(const Scenario& scenario, const MatchOptions& options,
                               sim::Simulation simulation, const VariableCatalog& catalog)
    : m_scenario(scenario),
      m_options(options),
      m_simulation(std::move(simulation)),
      m_catalog(&catalog),
      m_variables(catalog),
      m_bridge(m_variables),
      m_extendedBridge(RobotVariables(catalog.withExtension())),
      m_events(std::make_unique<MatchEvents>()),
      m_referee(std::make_unique<MatchReferee>()),
      m_processes(std::make_unique<ProcessManager>(options.robotProgram)) {}

SimulatedMatch::SimulatedMatch(SimulatedMatch&&) noexcept = default;

SimulatedMatch& SimulatedMatch::operator=(SimulatedMatch&& other) noexcept {
  if (this != &other) {
    std::destroy_at(this);  // in its order: processes end before their blackboards go
    std::construct_at(this, std::move(other));
  }
  return *this;
}

SimulatedMatch::~SimulatedMatch() {
  m_processes.reset();
  m_seats.clear();  // its robots before its number: whoever gets that takes them at once
}

Result<SimulatedMatch> SimulatedMatch::create(const Scenario& scenario, const MatchOptions& options,
                                              const VariableCatalog& catalog) {
  auto simulation = sim::Simulation::create(scenario.settings);
  if (!simulation) return tl::unexpected(simulation.error());
  SimulatedMatch match(scenario, options, std::move(*simulation), catalog);
  if (auto placed = match.m_simulation.placeBall(scenario.ball, scenario.ballVelocity); !placed) {
    return tl::unexpected(placed.error());
  }
  match.m_simulation.setClockRunning(scenario.clockRunning);
  match.m_processes->setClocksFollow(options.speed != 1.0);
  if (options.speed > 0.0) {
    match.m_processes->setSpeed(options.speed, std::chrono::steady_clock::now());
  }
  if (options.thoughts && options.cognition == Cognition::External) {
    auto receiver = ThoughtsReceiver::listen();
    if (!receiver) return tl::unexpected(receiver.error());
    match.m_thoughts = std::move(*receiver);
  }
  match.m_simulation.setScore(scenario.score);
  match.m_simulation.editState().clockTicks =
      firstTickAtOrAfter(scenario.clock, scenario.settings.tickRate);
  if (auto resolved = match.resolveWrites(); !resolved) return tl::unexpected(resolved.error());
  for (const ScenarioRobot& robot : scenario.robots) {
    if (auto added = match.addRobot(robot); !added) return tl::unexpected(added.error());
  }
  if (auto begun = match.beginGame(); !begun) return tl::unexpected(begun.error());
  match.applyDueWrites();
  return match;
}

/// Once everybody is there: who keeps which goal, and how the referee is heard.
Result<void> SimulatedMatch::beginGame() {
  const auto& rules = m_scenario.settings.referee;
  if (m_options.obeyReferee && !rules) {
    return failure(ErrorCode::InvalidArgument,
                   "this scenario has no referee; a match that obeys a GameController needs rules: "
                   "set \"referee\" in the scenario, for example to \"humanoid-2021\"");
  }
  if (!rules) return {};
  if (auto begun = m_simulation.setReferee(rules); !begun) return begun;
  sim::WorldState& world = m_simulation.editState();
  const std::size_t left = world.game->leftTeam();
  world.game->teams[left].score = m_scenario.score.left;
  world.game->teams[1 - left].score = m_scenario.score.right;
  world.score = m_scenario.score;
  if (m_options.obeyReferee) {
    if (auto obeyed = m_referee->obey(*m_options.obeyReferee, m_simulation); !obeyed) return obeyed;
  } else if (m_options.sendReferee || m_options.cognition != Cognition::Inline) {
    if (auto sent = m_referee->sendTo(m_options.process.refereePort); !sent) return sent;
  }
  hearReferee();
  return {};
}

/// Our communication process would hear the packets at a time of its own, and many a program hears
/// none: the match writes what they mean.
void SimulatedMatch::hearReferee(bool again) {
  if (!m_referee->tick(m_simulation, again)) return;
  const sim::WorldState& world = m_simulation.state();
  for (std::size_t i = 0; i < m_seats.size(); ++i) {
    const sim::RobotIdentity& robot = world.robots[i];
    const int team = world.game->teamOf(robot.team);
    if (team < 0 || m_seats[i]->runtime.hearsReferee) continue;
    const sim::GameTeam& own = world.game->teams[static_cast<std::size_t>(team)];
    if (const auto word =
            m_seats[i]->orders.take(m_referee->packet(), own.number, own.slotOf(robot.number))) {
      m_seats[i]->board.write(m_variables.comReferee, *word);
    }
  }
}

/// Teams that have changed sides start their processes again, told where they attack.
void SimulatedMatch::followSides() {
  const auto& robots = m_simulation.state().robots;
  for (std::size_t i = 0; i < m_seats.size(); ++i) {
    if (m_seats[i]->facesLeft == robots[i].imuStartsAt180) continue;
    (void)restartProcesses(*m_seats[i]);
  }
}

Result<void> SimulatedMatch::resolveWrites() {
  for (const BlackboardWrite& write : m_scenario.writes) {
    const Variable* variable = m_catalog->find(write.variable);
    if (!variable) {
      return failure(ErrorCode::NotFound, "the scenario writes \"" + write.variable +
                                              "\", which is not in this variable catalog");
    }
    ResolvedWrite resolved;
    resolved.tick = firstTickAtOrAfter(write.time, m_scenario.settings.tickRate);
    resolved.robot = write.robot;
    if (variable->type == VariableType::Int) {
      resolved.variable = IntVar{variable->index};
    } else {
      resolved.variable = FloatVar{variable->index};
    }
    resolved.value = write.value;
    m_writes.push_back(resolved);
  }
  std::stable_sort(m_writes.begin(), m_writes.end(),
                   [](const auto& a, const auto& b) { return a.tick < b.tick; });
  return {};
}

void SimulatedMatch::apply(const ResolvedWrite& write) {
  for (const auto& seat : m_seats) {
    if (write.robot.value == 0 || write.robot == seat->id) seat->write(write.variable, write.value);
  }
}

void SimulatedMatch::applyDueWrites() {
  const std::uint64_t now = m_simulation.state().tick;
  for (; m_nextWrite < m_writes.size() && m_writes[m_nextWrite].tick <= now; ++m_nextWrite) {
    apply(m_writes[m_nextWrite]);
  }
}

/// After a saved moment was put back: what is due follows the simulation's time.
void SimulatedMatch::followJump() {
  const std::uint64_t now = m_simulation.state().tick;
  const auto next = std::lower_bound(
      m_writes.begin(), m_writes.end(), now,
      [](const ResolvedWrite& write, std::uint64_t tick) { return write.tick < tick; });
  m_nextWrite = static_cast<std::size_t>(next - m_writes.begin());
  for (const auto& seat : m_seats) {
    for (const auto& process : seat->processes) {
      if (process->known) process->nextTick = nextDueTick(process->period, now);
    }
  }
  m_goalSeen = m_outSeen = false;
}

const BlackboardBridge& SimulatedMatch::bridgeOf(const Seat& seat) const {
  return seat.extended ? m_extendedBridge : m_bridge;
}

void SimulatedMatch::tick() {
  if (m_simulation.state().tick != m_expectedTick) followJump();
  applyDueWrites();
  for (std::size_t i = 0; i < m_seats.size(); ++i) m_commands[i] = m_bridge.read(m_seats[i]->board);
  advance(false);
}

/// One tick with the commands that were read. One that is played `again` was told of already.
void SimulatedMatch::advance(bool again) {
  m_simulation.step(m_commands, m_percepts);
  if (!again) m_events->stepped(m_simulation);
  for (const sim::Event& event : m_simulation.events()) {
    m_goalSeen = m_goalSeen || event.kind == sim::EventKind::Goal;
    m_outSeen = m_outSeen || event.kind == sim::EventKind::BallOut;
  }
  for (std::size_t i = 0; i < m_seats.size(); ++i) {
    bridgeOf(*m_seats[i]).publish(m_percepts[i], m_seats[i]->board);
  }
  m_expectedTick = m_simulation.state().tick;
  if (m_simulation.state().game) {
    followSides();
    hearReferee(again);
  }
  runProcesses();
}

/// The first tick after `after` at which a multiple of `period` seconds has passed.
std::uint64_t SimulatedMatch::nextDueTick(double period, std::uint64_t after) const {
  const double rate = m_scenario.settings.tickRate;
  const double ticksPerCycle = period * rate;
  if (!(ticksPerCycle > 1.0)) return after + 1;
  const double cycle = std::floor((static_cast<double>(after) + tickTolerance) / ticksPerCycle) + 1;
  return std::max(after + 1, firstTickAtOrAfter(cycle * period, rate));
}

std::string_view SimulatedMatch::finishedBy() const {
  const StopConditions& stop = m_scenario.stop;
  if (stop.goal && m_goalSeen) return "goal";
  if (stop.ballOut && m_outSeen) return "ball_out";
  if (stop.duration && m_simulation.state().tick >=
                           firstTickAtOrAfter(*stop.duration, m_scenario.settings.tickRate)) {
    return "duration";
  }
  if (m_simulation.state().game && m_simulation.state().game->over) return "full_time";
  return {};
}

void SimulatedMatch::takeEvents(std::vector<MatchEvent>& out) {
  m_events->look(m_simulation.state(), finishedBy());
  m_events->takeNews(m_simulation.state(), m_processes->takeNews());
  m_events->take(out);
}

void SimulatedMatch::takeDrawings(std::vector<HeardDrawing>& out) {
  if (!m_claim) return;
  if (!m_drawings) m_drawings = std::make_unique<MatchDrawings>(number()->drawingPort());
  const sim::WorldState& state = m_simulation.state();
  m_drawings->hear(static_cast<double>(state.tick) / state.settings.tickRate, out);
}

std::vector<RobotThoughts> SimulatedMatch::thoughts() {
  if (m_thoughts) {
    const auto now = std::chrono::steady_clock::now();
    m_thoughts->poll(now);
    return m_thoughts->thoughts(now);
  }
  std::vector<RobotThoughts> all;
  if (!m_options.thoughts) return all;
  for (const auto& seat : m_seats) {
    RobotThoughts one;
    one.robot = seat->id;
    for (const auto& process : seat->processes) {
      if (process->inside) process->inside->tellThoughts(one);
    }
    if (one.cloud || one.path) all.push_back(std::move(one));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.robot < b.robot; });
  return all;
}

SimulatedMatch::Seat* SimulatedMatch::seat(RobotId id) const {
  const auto found = std::find_if(m_seats.begin(), m_seats.end(),
                                  [id](const auto& seat) { return seat->id == id; });
  return found == m_seats.end() ? nullptr : found->get();
}

Blackboard* SimulatedMatch::blackboard(RobotId id) {
  Seat* found = seat(id);
  return found ? &found->board : nullptr;
}

const Blackboard* SimulatedMatch::blackboard(RobotId id) const {
  const Seat* found = seat(id);
  return found ? &found->board : nullptr;
}

std::string_view SimulatedMatch::behaviour(RobotId id) const {
  const Seat* found = seat(id);
  return found ? std::string_view(found->behaviour) : std::string_view();
}

RobotId SimulatedMatch::freeRobotId() const {
  RobotId id{1};
  while (seat(id)) ++id.value;
  return id;
}

}  // namespace pitchboard::link
