// SPDX-License-Identifier: GPL-3.0-or-later
// Robots coming and going: blackboards, claims, processes; and the match as a scenario.
#include <algorithm>
#include <array>
#include <cstdio>

#include <base/lined_json.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/moment_writes.h>

#include "match_seat.h"

namespace pitchboard::link {
namespace {

/// Whether the robot's processes were told something else: how it walks, kicks and how wide it is.
bool isToldOtherwise(const sim::RobotModel& a, const sim::RobotModel& b) {
  const auto told = [](const sim::RobotModel& m) {
    return std::array{m.forwardFast, m.forwardSlow,    m.backwardFast, m.backwardSlow, m.sideways,
                      m.turn,        m.aroundSideways, m.aroundTurn,   m.kickReach,    m.radius};
  };
  return told(a) != told(b) || a.kickLaw != b.kickLaw;
}

tl::unexpected<Error> noSuchRobot(RobotId id) {
  return failure(ErrorCode::NotFound,
                 "there is no robot " + std::to_string(id.value) + " on the field");
}

/// Refuses a name that is neither one of our behaviours nor "none of ours".
Result<void> checkBehaviour(const std::string& behaviour) {
  const auto known = behaviours();
  if (behaviour != noBehaviour && std::none_of(known.begin(), known.end(), [&](const auto& b) {
        return b.name == behaviour;
      })) {
    std::vector<std::string_view> names;
    for (const BehaviourInfo& b : known) names.push_back(b.name);
    names.push_back(noBehaviour);
    return failure(ErrorCode::NotFound, unknownName("behaviour", behaviour, names));
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<SimulatedMatch::Seat>> SimulatedMatch::makeSeat(const Wish& wish) {
  const RobotId id = wish.id;
  auto runtime = runtimeFor(wish);
  if (!runtime) return tl::unexpected(runtime.error());
  auto seat = std::make_unique<Seat>(Blackboard::onHeap());
  seat->id = id;
  seat->behaviour = wish.behaviour;
  seat->choice = wish.choice;
  bool fresh = true;
  if (sharesBoard(*seat, *runtime)) {
    if (auto identified = identify(); !identified) return tl::unexpected(identified.error());
    const int key = keyOf(id);
    auto claim = BridgeClaim::take(key);
    if (!claim) return tl::unexpected(claim.error());
    // The guard is there before the segment, so that not even a kill between the two leaves it. A
    // match without processes goes on without it; one with processes says why it cannot.
    if (!m_options.robotProgram.empty()) (void)m_processes->keepGuard();
    auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
    if (!board) return tl::unexpected(board.error());
    m_processes->guardSegment(*board);
    fresh = board->created();
    seat->claim = std::move(*claim);
    seat->board = std::move(*board);
  }
  seat->runtime = std::move(*runtime);
  // A segment that was there belongs to processes that may be running: it is left as it is.
  if (fresh && m_variables.decisionSearchOn.index >= 0) {
    seat->board.write(m_variables.decisionSearchOn, 1);
  }
  return seat;
}

Result<void> SimulatedMatch::checkShirt(const sim::RobotIdentity& identity) const {
  for (const sim::RobotIdentity& other : m_simulation.state().robots) {
    if (other.id != identity.id && other.team == identity.team && other.number == identity.number) {
      return failure(ErrorCode::Conflict,
                     "there is already a robot " + identity.name() + "; choose another number");
    }
  }
  return {};
}

Result<void> SimulatedMatch::addRobot(const ScenarioRobot& robot) {
  if (auto free = checkShirt(robot.identity); !free) return free;
  if (auto known = checkBehaviour(robot.behaviour); !known) return known;
  if (auto added = m_simulation.addRobot(robot.identity, robot.pose, robot.model); !added)
    return added;
  const RobotId id = robot.identity.id;
  const auto giveUp = [&](const Error& error) {
    m_processes->remove(id);
    (void)m_simulation.removeRobot(id);
    return tl::unexpected(error);
  };
  auto seat = makeSeat({id, robot.behaviour, m_scenario.runtimeOf(robot)});
  if (!seat) return giveUp(seat.error());
  (*seat)->parameters = robot.parameters;
  for (std::size_t i = 0; i < m_nextWrite; ++i) {
    const ResolvedWrite& write = m_writes[i];
    if (write.robot.value == 0) (*seat)->write(write.variable, write.value);
  }
  if (auto started = startProcesses(**seat); !started) return giveUp(started.error());
  m_seats.push_back(std::move(*seat));
  m_commands.resize(m_seats.size());
  m_percepts.resize(m_seats.size());
  return {};
}

Result<void> SimulatedMatch::removeRobot(RobotId id) {
  const auto index = m_simulation.indexOf(id);
  if (auto removed = m_simulation.removeRobot(id); !removed) return removed;
  endProcesses(*m_seats[*index]);
  m_seats.erase(m_seats.begin() + static_cast<std::ptrdiff_t>(*index));
  m_commands.resize(m_seats.size());
  m_percepts.resize(m_seats.size());
  return {};
}

Result<void> SimulatedMatch::reenter(const Moment& moment) {
  const sim::WorldState before = m_simulation.state();
  if (moment.state.settings.tickRate != m_scenario.settings.tickRate) {
    return failure(ErrorCode::InvalidArgument,
                   "this moment was played at another tick rate than this match; start a match of "
                   "its own scenario");
  }
  // Everything that can fail comes before anything of the present match is given up.
  std::vector<std::unique_ptr<Seat>> added;
  const auto addedSeat = [&](RobotId id) -> Seat* {
    for (const auto& one : added) {
      if (one && one->id == id) return one.get();
    }
    return nullptr;
  };
  for (const sim::RobotIdentity& identity : moment.state.robots) {
    if (seat(identity.id)) continue;
    const MomentRobot* known = moment.robot(identity.id);
    auto made = makeSeat({identity.id, known ? known->behaviour : std::string(noBehaviour),
                          m_scenario.runtimeOf(identity.team, {})});
    if (!made) return tl::unexpected(made.error());
    for (const ScenarioRobot& one : m_scenario.robots) {
      if (one.identity.id == identity.id) (*made)->parameters = one.parameters;
    }
    added.push_back(std::move(*made));
  }
  for (const sim::RobotIdentity& identity : moment.state.robots) {
    const MomentRobot* known = moment.robot(identity.id);
    const Seat* here = seat(identity.id);
    if (!known || !here || known->behaviour == here->behaviour) continue;
    if (auto set = setBehaviour(identity.id, known->behaviour); !set) return set;
  }
  if (auto put = m_simulation.restore(moment.state); !put) return put;
  for (const auto& one : added) {
    if (auto started = startProcesses(*one); !started) {
      for (const auto& other : added) endProcesses(*other);
      (void)m_simulation.restore(before);
      return started;
    }
  }
  for (const auto& old : m_seats) {
    if (!m_simulation.indexOf(old->id)) endProcesses(*old);
  }
  std::vector<std::unique_ptr<Seat>> seats;
  for (const sim::RobotIdentity& identity : moment.state.robots) {
    auto& from = addedSeat(identity.id) ? added : m_seats;
    const auto found = std::find_if(from.begin(), from.end(),
                                    [&](const auto& one) { return one && one->id == identity.id; });
    seats.push_back(std::move(*found));
  }
  m_seats = std::move(seats);
  m_commands.assign(m_seats.size(), {});
  m_percepts.resize(m_seats.size());
  m_scenario.settings = moment.state.settings;
  const auto writeBoards = [&] {
    for (const auto& one : m_seats) {
      if (const MomentRobot* known = moment.robot(one->id)) known->writeTo(one->board);
    }
  };
  writeBoards();
  startAnew();
  if (moment.past && moment.past->memory) {
    playThrough(*moment.past);
    (void)m_simulation.restore(moment.state);
    m_scenario.settings = moment.state.settings;
    writeBoards();
  }
  followJump();
  m_expectedTick = moment.state.tick;
  return {};
}

Result<void> SimulatedMatch::setBehaviour(RobotId id, const std::string& behaviour) {
  Seat* changed = seat(id);
  if (!changed) return noSuchRobot(id);
  if (auto known = checkBehaviour(behaviour); !known) return known;
  const std::string before = std::exchange(changed->behaviour, behaviour);
  // Nobody said who runs, so the behaviour does: without one the robot is somebody else's.
  const RuntimeProfile runtimeBefore = changed->runtime;
  auto runtime = runtimeFor({id, behaviour, changed->choice});
  if (!runtime) {
    changed->behaviour = before;
    return tl::unexpected(runtime.error());
  }
  changed->runtime = std::move(*runtime);
  // What hangs on the behaviour starts anew, the rest goes on.
  std::vector<std::unique_ptr<SeatProcess>> ended;
  for (auto& process : changed->processes) {
    if (process->profile.onlyFor == ProfileProcess::OnlyFor::Behaviour) {
      if (process->id != 0) m_processes->stop(process->id);
      ended.push_back(std::move(process));
    }
  }
  std::erase(changed->processes, nullptr);
  auto started = startProcesses(*changed);
  if (!started) {
    changed->behaviour = before;
    changed->runtime = runtimeBefore;
    for (auto& process : ended) changed->processes.push_back(std::move(process));
    return started;
  }
  std::swap(changed->processes, ended);
  endProcesses(*changed);
  changed->processes = std::move(ended);
  return {};
}

Result<void> SimulatedMatch::setRuntime(RobotId id, const RuntimeChoice& choice) {
  Seat* changed = seat(id);
  if (!changed) return noSuchRobot(id);
  auto runtime =
      runtimeFor({id, changed->behaviour, m_scenario.runtimeOf(identityOf(id).team, choice)});
  if (!runtime) return tl::unexpected(runtime.error());
  if (changed->board.key() == 0 && runtime->hasOwn() && choice.isChosen()) {
    return failure(
        ErrorCode::Unsupported,
        "this match runs inside one program, where no other one reaches its blackboards; "
        "start it with separate processes");
  }
  const RuntimeProfile before = std::exchange(changed->runtime, std::move(*runtime));
  const RuntimeChoice choiceBefore = std::exchange(changed->choice, choice);
  auto started = restartProcesses(*changed);
  if (!started) {
    changed->runtime = before;
    changed->choice = choiceBefore;
  }
  return started;
}

RuntimeChoice SimulatedMatch::runtime(RobotId id) const {
  const Seat* found = seat(id);
  return found ? found->choice : RuntimeChoice{};
}

Result<void> SimulatedMatch::restartProcess(RobotId id, const std::string& process) {
  Seat* changed = seat(id);
  if (changed) {
    for (const auto& one : changed->processes) {
      if (one->profile.name != process) continue;
      if (one->inside) return startInside(*changed, *one);
      m_processes->restart(one->id, std::chrono::steady_clock::now());
      return {};
    }
  }
  return failure(ErrorCode::NotFound, "robot " + std::to_string(id.value) +
                                          " has no process called \"" + process + "\"");
}

Result<void> SimulatedMatch::setIdentity(const sim::RobotIdentity& identity) {
  Seat* changed = seat(identity.id);
  if (!changed) return noSuchRobot(identity.id);
  if (auto free = checkShirt(identity); !free) return free;
  const std::size_t index = *m_simulation.indexOf(identity.id);
  sim::RobotIdentity& robot = m_simulation.editState().robots[index];
  const sim::RobotIdentity before = std::exchange(robot, identity);
  auto started = restartProcesses(*changed);
  if (!started) robot = before;
  return started;
}

const sim::RobotModel* SimulatedMatch::robotModel(RobotId id) const {
  const auto index = m_simulation.indexOf(id);
  return index ? &m_simulation.state().models[*index] : nullptr;
}

Result<void> SimulatedMatch::setRobotModel(RobotId id, const sim::RobotModel& model) {
  Seat* changed = seat(id);
  if (!changed) return noSuchRobot(id);
  const sim::RobotModel before = *robotModel(id);
  if (before == model) return {};
  if (auto set = m_simulation.setRobotModel(id, model); !set) return set;
  if (!isToldOtherwise(before, model)) return {};
  auto started = restartProcesses(*changed);
  if (!started) (void)m_simulation.setRobotModel(id, before);
  return started;
}

Scenario SimulatedMatch::toScenario() const {
  const sim::WorldState& state = m_simulation.state();
  const sim::Snapshot now = m_simulation.snapshot();
  const sim::FieldSpec& field = state.settings.field;
  const auto inside = [&](const Point& point) {
    const double x = field.halfLength() + field.border;
    const double y = field.halfWidth() + field.border;
    return Point{std::clamp(point.x, -x, x), std::clamp(point.y, -y, y)};
  };

  Scenario moment = m_scenario;
  char clock[32];
  std::snprintf(clock, sizeof clock, "%.1f", now.time);
  if (state.tick > 0) {
    const std::string& title = m_scenario.title.empty() ? m_scenario.name : m_scenario.title;
    moment.title = title + ", at " + clock + " s";
  }
  moment.settings = state.settings;
  moment.ball = inside(now.ball);
  moment.ballVelocity = now.ballVelocity;
  moment.clockRunning = state.clockRunning;
  moment.clock = now.clock;
  moment.score = now.score;
  moment.robots.clear();
  for (std::size_t i = 0; i < m_seats.size(); ++i) {
    const sim::RobotSnapshot& robot = now.robots[i];
    moment.robots.push_back({robot.identity,
                             {inside(robot.pose.position), robot.pose.yaw},
                             m_seats[i]->behaviour,
                             m_seats[i]->choice,
                             state.models[i],
                             m_seats[i]->parameters});
  }

  moment.writes =
      writesFrom(m_scenario.writes, now.time, [this](RobotId id) { return seat(id) != nullptr; });
  return moment;
}

}  // namespace pitchboard::link
