// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/simulated_match.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <base/try.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/moment.h>
#include <robotlink/scenario/moment_writes.h>
#include <simcore/rules/check_call.h>
#include <simcore/rules/game_start.h>
#include <simcore/world/published_frame.h>

#include "match_parts.h"

namespace pitchboard::link {

namespace {

void writeBelief(const ScenarioBelief& belief, const sim::FieldSpec& field,
                 const RobotVariables& variables, Blackboard& board) {
  const auto pose = sim::published_frame::localizationFromStudio(field, belief.pose);
  writeIfPresent(board, variables.localizationX, static_cast<int>(std::lround(pose.x)));
  writeIfPresent(board, variables.localizationY, static_cast<int>(std::lround(pose.y)));
  writeIfPresent(board, variables.localizationTheta, static_cast<int>(std::lround(pose.degrees)));
  writeIfPresent(board, variables.localizationBelief,
                 static_cast<float>(sim::published_frame::cmFromMetres(belief.sigma)));
}

/// Nothing of a robot that has not found out, or that stands where no field is.
std::optional<ScenarioBelief> beliefOn(const Blackboard& board, const RobotVariables& variables,
                                       const sim::FieldSpec& field) {
  constexpr double maxSigma = 10.0;  // m, as files have it
  const double sigma_cm = static_cast<double>(readOr(board, variables.localizationBelief));
  if (!std::isfinite(sigma_cm) || sigma_cm <= 0.0) return {};
  const auto read = [&board](IntVar variable) {
    return static_cast<double>(readOr(board, variable));
  };
  ScenarioBelief belief;
  belief.pose = sim::published_frame::studioFromLocalization(
      field, {read(variables.localizationX), read(variables.localizationY),
              read(variables.localizationTheta)});
  belief.sigma = sim::published_frame::metresFromCm(sigma_cm);
  const bool inside = std::abs(belief.pose.position.x) <= field.halfLength() + field.border &&
                      std::abs(belief.pose.position.y) <= field.halfWidth() + field.border;
  if (!inside || belief.sigma > maxSigma) return {};
  return belief;
}

}  // namespace

SimulatedMatch::SimulatedMatch(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
SimulatedMatch::SimulatedMatch(SimulatedMatch&&) noexcept = default;
SimulatedMatch& SimulatedMatch::operator=(SimulatedMatch&&) noexcept = default;
SimulatedMatch::~SimulatedMatch() = default;

Result<SimulatedMatch> SimulatedMatch::create(const Scenario& scenario, const MatchOptions& options,
                                              const VariableCatalog& catalog) {
  auto simulation = TRY(sim::Simulation::create(scenario.settings));
  auto writes = TRY(TimedWrites::create(scenario, catalog));
  auto parts = std::make_unique<Parts>(MatchBase{scenario, options, std::move(simulation), &catalog,
                                                 RobotVariables(catalog), std::move(writes)});
  MatchBase& base = parts->base;
  TRY(base.simulation.placeBall(scenario.ball, scenario.ballVelocity));
  base.simulation.setClockRunning(scenario.clockRunning);
  parts->pace.slowTo(options.speed, std::chrono::steady_clock::now());
  if (options.cognitionDebug && options.cognition == Cognition::Separate) {
    base.cognitionDebug = TRY(CognitionDebugReceiver::listen());
  }
  base.simulation.setScore(scenario.score);
  base.simulation.editState().clockTicks =
      firstTickAtOrAfter(scenario.clock, scenario.settings.tickRate);
  for (const ScenarioRobot& robot : scenario.robots) {
    TRY(parts->slots.add(robot));
  }
  parts->rememberBeliefs();
  TRY(parts->beginGame());
  base.writes.applyDue(base.tick(), parts->slots);
  return SimulatedMatch(std::move(parts));
}

/// Where robots believe that they are stands on their blackboards before their processes begin.
void SimulatedMatch::Parts::rememberBeliefs() {
  for (const ScenarioRobot& robot : base.scenario.robots) {
    RobotSlot* slot = robot.belief ? slots.find(robot.identity.id) : nullptr;
    if (!slot) continue;
    writeBelief(*robot.belief, base.scenario.settings.field, base.variables, slot->board);
    for (const auto& process : slot->processes) {
      if (process->inside) process->inside->resume(slot->board);
    }
  }
}

/// Called once all robots are there: sets their goals, and how they receive the referee.
Result<void> SimulatedMatch::Parts::beginGame() {
  const auto& rules = base.scenario.settings.referee;
  if (base.options.obeyReferee && !rules) {
    return failure(ErrorCode::InvalidArgument,
                   "this scenario has no referee; a match that obeys a GameController needs rules: "
                   "set \"referee\" in the scenario, for example to \"humanoid-2021\"");
  }
  if (!rules) return {};
  TRY(base.simulation.setReferee(rules));
  sim::GameStart start;
  if (base.scenario.game) {
    start = *base.scenario.game;
  } else {
    const Game& game = *base.simulation.state().game;
    start.teams[game.teams[game.leftTeam()].colour].score = base.scenario.score.left;
    start.teams[game.teams[1 - game.leftTeam()].colour].score = base.scenario.score.right;
  }
  TRY(base.simulation.startGame(start));
  if (base.options.obeyReferee) {
    TRY(referee.obey(*base.options.obeyReferee, base.simulation));
    if (base.options.answerReferee) referee.answerTo(*base.options.answerReferee);
  } else if (base.options.sendReferee || slots.haveTeamPrograms()) {
    TRY(referee.sendTo(base.options.process.refereePort));
  }
  deliverReferee();
  return {};
}

/// Our communication process would receive the packets at its own time, and many programs receive
/// none: the match writes what they mean.
void SimulatedMatch::Parts::deliverReferee(bool again) {
  if (!referee.tick(base.simulation, again)) return;
  const sim::WorldState& world = base.simulation.state();
  for (std::size_t i = 0; i < slots.all().size(); ++i) {
    const sim::RobotIdentity& robot = world.robots[i];
    const int team = world.game->teamOf(robot.team);
    if (team < 0 || slots.all()[i]->runtime.readsReferee) continue;
    const GameTeam& own = world.game->teams[static_cast<std::size_t>(team)];
    RobotSlot& slot = *slots.all()[i];
    if (const auto order =
            slot.orders.take(referee.heard(), own.number, own.slotOf(robot.number))) {
      refereeVariables.write(slot.board, *order, referee.heard(), own.number, slot.extended);
    }
  }
}

/// Our processes of teams that have changed sides start again, told where they attack. A team's own
/// programs go on: they find out as on a real field.
void SimulatedMatch::Parts::followSides() {
  for (std::size_t i = 0; i < slots.all().size(); ++i) {
    const bool facesLeft = base.simulation.state().robots[i].imuStartsAt180;
    RobotSlot& slot = *slots.all()[i];
    if (slot.facesLeft == facesLeft) continue;
    (void)slots.change(slot.id, [](RobotSlot& changed) -> Result<void> {
      std::erase_if(changed.processes, [](const auto& one) { return one->profile.isReference(); });
      return {};
    });
    slot.facesLeft = facesLeft;  // also when it has none, or they do not start
  }
}

/// After a saved moment was put back: what is due follows the simulation's time.
void SimulatedMatch::Parts::followJump() {
  base.writes.jumpTo(base.tick());
  lockStep.jump();
  end.forget();
  events.forgetSight();
}

void SimulatedMatch::tick() {
  MatchBase& base = m_parts->base;
  if (base.tick() != m_parts->expectedTick) m_parts->followJump();
  base.writes.applyDue(base.tick(), robots());
  for (std::size_t i = 0; i < base.commands.size(); ++i) {
    base.commands[i] = m_parts->bridge.read(robots().all()[i]->board);
  }
  m_parts->following.place(base.simulation, base.commands);
  m_parts->advance(false);
}

void SimulatedMatch::follow(std::shared_ptr<const FollowedRecording> recording) {
  m_parts->following.begin(std::move(recording));
}

const FollowState& SimulatedMatch::followState() const {
  return m_parts->following.state();
}

/// Robots that followed go on by themselves, from where they stand: our processes, which have seen
/// motions that they did not command, are told. A team's own programs go on: they find out as on a
/// real field when somebody carries the robot.
void SimulatedMatch::Parts::letGo() {
  events.letGo(following.state());
  for (const FollowedRobot& robot : following.recording()->robots) {
    RobotSlot* slot = robot.follows ? slots.find(robot.id) : nullptr;
    if (!slot) continue;
    constexpr double sigma = 0.1;  // m
    writeBelief({*base.simulation.robotPose(robot.id), sigma}, base.scenario.settings.field,
                base.variables, slot->board);
    startAnew(*slot);
    lockStep.beginAnew(*slot);
  }
}

/// One tick with the commands that were read. If it is played `again`, its events were reported
/// before.
void SimulatedMatch::Parts::advance(bool again) {
  base.simulation.step(base.commands, base.percepts);
  const bool letsGo = following.settle(base.simulation);
  if (!again) events.stepped(base.simulation);
  events.sensed(base.simulation.state(), base.percepts, again);
  end.look(base.simulation.events());
  for (std::size_t i = 0; i < slots.all().size(); ++i) {
    RobotSlot& slot = *slots.all()[i];
    (slot.extended ? extendedBridge : bridge).publish(base.percepts[i], slot.board);
  }
  if (letsGo) letGo();
  expectedTick = base.simulation.state().tick;
  if (base.simulation.state().game) {
    followSides();
    deliverReferee(again);
  }
  lockStep.run();
}

std::string_view SimulatedMatch::finishedBy() const {
  return m_parts->end.reason(scenario().stop, simulation().state());
}

bool SimulatedMatch::nobodyPlays() const {
  constexpr std::uint64_t patience_s = 5;
  const MatchBase& base = m_parts->base;
  const sim::WorldState& state = simulation().state();
  if (state.game || state.robots.empty()) return false;
  if (state.tick < patience_s * static_cast<std::uint64_t>(base.tickRate())) return false;
  return std::ranges::none_of(state.statistics,
                              [](const auto& one) { return one.distanceWalked > 0.0; }) &&
         std::ranges::none_of(m_parts->slots.all(), [&base](const auto& slot) {
           return slot->board.read(base.variables.comReferee) == refereePlay;
         });
}

void SimulatedMatch::drainEvents(std::vector<MatchEvent>& out) {
  MatchEvents& events = m_parts->events;
  events.called(simulation());
  events.look(simulation().state(), finishedBy());
  events.drainNews(simulation().state(), robots().processes().drainNews());
  events.take(out);
}

void SimulatedMatch::takeDrawings(std::vector<ReceivedDrawing>& out) {
  const auto& claim = robots().claim();
  if (!claim) return;
  auto& drawings = m_parts->drawings;
  if (!drawings) drawings = std::make_unique<MatchDrawings>(claim->number().drawingPort());
  const sim::WorldState& state = simulation().state();
  drawings->receive(static_cast<double>(state.tick) / state.settings.tickRate, out);
}

std::vector<CognitionDebug> SimulatedMatch::cognitionDebug() {
  if (auto& received = m_parts->base.cognitionDebug) {
    const auto now = std::chrono::steady_clock::now();
    received->poll(now);
    return received->cognitionDebug(now);
  }
  std::vector<CognitionDebug> all;
  if (!m_parts->base.options.cognitionDebug) return all;
  for (const auto& slot : robots().all()) {
    CognitionDebug one;
    one.robot = slot->id;
    for (const auto& process : slot->processes) {
      if (process->inside) process->inside->sendDebugData(one);
    }
    if (one.cloud || one.path) all.push_back(std::move(one));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.robot < b.robot; });
  return all;
}

const MatchDrawings* SimulatedMatch::drawings() const {
  return m_parts->drawings.get();
}

const Scenario& SimulatedMatch::scenario() const {
  return m_parts->base.scenario;
}

sim::Simulation& SimulatedMatch::simulation() {
  return m_parts->base.simulation;
}

const sim::Simulation& SimulatedMatch::simulation() const {
  return m_parts->base.simulation;
}

RobotSlots& SimulatedMatch::robots() {
  return m_parts->slots;
}

const RobotSlots& SimulatedMatch::robots() const {
  return m_parts->slots;
}

Blackboard* SimulatedMatch::blackboard(RobotId id) const {
  RobotSlot* found = robots().find(id);
  return found ? &found->board : nullptr;
}

const RobotVariables& SimulatedMatch::variables() const {
  return m_parts->base.variables;
}

const VariableCatalog& SimulatedMatch::catalog() const {
  return *m_parts->base.catalog;
}

std::span<const sim::RobotCommand> SimulatedMatch::commands() const {
  return m_parts->base.commands;
}

std::span<const sim::Percepts> SimulatedMatch::percepts() const {
  return m_parts->base.percepts;
}

ProcessPace& SimulatedMatch::pace() const {
  return m_parts->pace;
}

bool SimulatedMatch::isRepeatable() const {
  const auto others = robots().ofOthers();
  const auto isOwn = [](const auto& process) { return !process->profile.isReference(); };
  const auto repeats = [&](const auto& slot) {
    const bool own = std::ranges::any_of(slot->processes, isOwn) || slot->cycle.index >= 0 ||
                     std::ranges::find(others, slot->id, &sim::RobotIdentity::id) != others.end();
    return !own || (slot->cooperates && !slot->hasMissedCycle);
  };
  return std::ranges::all_of(robots().all(), repeats) &&
         (pace().inLockStep() || !robots().lockStepSlots());
}

MatchResult SimulatedMatch::result() const {
  MatchResult out = resultOf(simulation().state(), finishedBy());
  if (const auto winner = sim::tossWinner(simulation().state())) {
    out.teams[static_cast<std::size_t>(*winner)].wonToss = true;
  }
  out.repeatable = isRepeatable();
  return out;
}

Scenario SimulatedMatch::toScenario() const {
  const sim::WorldState& state = m_parts->base.simulation.state();
  const sim::Snapshot now = m_parts->base.simulation.snapshot();
  const sim::FieldSpec& field = state.settings.field;
  const auto inside = [&](const Point& point) {
    const double x = field.halfLength() + field.border;
    const double y = field.halfWidth() + field.border;
    return Point{std::clamp(point.x, -x, x), std::clamp(point.y, -y, y)};
  };

  const auto& slots = robots().all();
  Scenario moment = m_parts->base.scenario;
  char clock[32];
  std::snprintf(clock, sizeof clock, "%.1f", now.time);
  if (state.tick > 0) {
    const std::string& title = m_parts->base.scenario.title.empty() ? m_parts->base.scenario.name
                                                                    : m_parts->base.scenario.title;
    moment.title = title + ", at " + clock + " s";
  }
  moment.settings = state.settings;
  moment.ball = inside(now.ball);
  moment.ballVelocity = now.ballVelocity;
  moment.clockRunning = state.clockRunning;
  moment.clock = state.game ? 0.0 : now.clock;
  moment.score = state.game ? sim::Score{} : now.score;
  moment.game.reset();
  if (state.game) moment.game = sim::gameStartOf(state);
  moment.robots.clear();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const sim::RobotSnapshot& robot = now.robots[i];
    moment.robots.push_back({robot.identity,
                             {inside(robot.pose.position), robot.pose.yaw},
                             slots[i]->behaviour,
                             slots[i]->choice,
                             state.models[i],
                             slots[i]->parameters,
                             beliefOn(slots[i]->board, variables(), field)});
  }

  moment.writes = writesFrom(m_parts->base.scenario.writes, now.time,
                             [this](RobotId id) { return robots().find(id) != nullptr; });
  return moment;
}

}  // namespace pitchboard::link
