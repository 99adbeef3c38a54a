// SPDX-License-Identifier: GPL-3.0-or-later
// Robots coming and going: blackboards, claims, processes; and the match as a scenario.
#include <algorithm>
#include <cstdio>

#include <base/lined_json.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/scenario/moment_writes.h>

#include "match_seat.h"

namespace pitchboard::link {
namespace {}  // namespace

bool SimulatedMatch::sharesBoards() const {
  return m_options.cognition != Cognition::Inline || m_options.systemV;
}

Result<std::unique_ptr<SimulatedMatch::Seat>> SimulatedMatch::makeSeat(
    const ScenarioRobot& robot) const {
  const RobotId id = robot.identity.id;
  std::unique_ptr<Seat> seat;
  bool fresh = true;
  if (sharesBoards()) {
    const int key = blackboardKey(id, m_options.keyBase);
    auto claim = BridgeClaim::take(key);
    if (!claim) return tl::unexpected(claim.error());
    auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
    if (!board) return tl::unexpected(board.error());
    fresh = board->created();
    seat = std::make_unique<Seat>(std::move(*board));
    seat->claim = std::move(*claim);
  } else {
    seat = std::make_unique<Seat>(Blackboard::onHeap());
  }
  seat->id = id;
  seat->behaviour = robot.behaviour;
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
  if (auto added = m_simulation.addRobot(robot.identity, robot.pose); !added) return added;
  const RobotId id = robot.identity.id;
  const auto giveUp = [&](const Error& error) {
    m_supervisor->stop(id);
    (void)m_simulation.removeRobot(id);
    return tl::unexpected(error);
  };
  auto seat = makeSeat(robot);
  if (!seat) return giveUp(seat.error());
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
  m_supervisor->stop(id);
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
      if (one->id == id) return one.get();
    }
    return nullptr;
  };
  for (const sim::RobotIdentity& identity : moment.state.robots) {
    if (seat(identity.id)) continue;
    const MomentRobot* known = moment.robot(identity.id);
    auto made = makeSeat({identity, {}, known ? known->behaviour : std::string(noBehaviour)});
    if (!made) return tl::unexpected(made.error());
    added.push_back(std::move(*made));
  }
  if (auto put = m_simulation.restore(moment.state); !put) return put;
  for (const auto& one : added) {
    if (auto started = startProcesses(*one); !started) {
      for (const auto& other : added) m_supervisor->stop(other->id);
      (void)m_simulation.restore(before);
      return started;
    }
  }
  for (const auto& old : m_seats) {
    if (!m_simulation.indexOf(old->id)) m_supervisor->stop(old->id);
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
  for (const auto& one : m_seats) {
    if (const MomentRobot* known = moment.robot(one->id)) known->writeTo(one->board);
  }
  m_scenario.settings = moment.state.settings;
  followJump();
  m_expectedTick = moment.state.tick;
  return {};
}

Result<void> SimulatedMatch::startProcesses(Seat& seat) {
  if (const auto index = m_simulation.indexOf(seat.id)) {
    seat.facesLeft = m_simulation.state().robots[*index].imuStartsAt180;
  }
  for (const ProcessInfo& process : cognitiveProcesses()) {
    if (auto started = startProcess(seat, process); !started) return started;
  }
  return {};
}

Result<void> SimulatedMatch::startProcess(Seat& seat, const ProcessInfo& process) {
  if (seat.behaviour == noBehaviour && process.hasBehaviour) return {};
  if (m_options.cognition == Cognition::External) {
    auto started =
        m_supervisor->start({seat.id, std::string(process.name), commandOf(seat, process)});
    if (!started) return tl::unexpected(started.error());
  } else if (m_options.cognition == Cognition::Inline && process.deterministic) {
    const BehaviourInfo* behaviour = findBehaviour(seat.behaviour);
    if (process.forPose && (!behaviour || !behaviour->usesPose)) return {};
    auto made = process.make(inlineOptions(seat));
    if (!made) return tl::unexpected(made.error());
    const std::uint64_t next = nextDueTick((*made)->period());
    seat.processes.push_back({&process, std::move(*made), next});
  }
  return {};
}

ProcessOptions SimulatedMatch::inlineOptions(const Seat& seat) {
  ProcessOptions options = m_options.process;
  options.robot = seat.id;
  options.behaviour = seat.behaviour;
  options.field = m_scenario.settings.field;
  options.seed = m_scenario.settings.seed;
  const sim::RobotIdentity& identity =
      m_simulation.state().robots[m_simulation.indexOf(seat.id).value()];
  options.facesLeft = identity.imuStartsAt180;
  auto& channel = m_teamChannels[static_cast<std::size_t>(identity.team)];
  if (!channel) channel = std::make_shared<InProcessTeamChannel>();
  options.teamChannel = channel;
  return options;
}

std::vector<std::string> SimulatedMatch::commandOf(const Seat& seat,
                                                   const ProcessInfo& process) const {
  const ProcessOptions& options = m_options.process;
  const sim::RobotIdentity& identity =
      m_simulation.state().robots[m_simulation.indexOf(seat.id).value()];
  std::vector<std::string> command{
      m_options.robotProgram,
      std::string(process.name),
      "--robot",
      std::to_string(seat.id.value),
      "--key",
      std::to_string(blackboardKey(seat.id, m_options.keyBase)),
      "--behaviour",
      seat.behaviour == noBehaviour ? options.behaviour : seat.behaviour,
      "--distance-to-kick",
      shortest(options.distanceToKick),
      "--udp-address",
      options.udpAddress,
      "--telemetry-port-base",
      std::to_string(options.telemetryPortBase),
      "--team-port-base",
      std::to_string(options.teamPortBase),
      "--team",
      std::to_string(options.team + static_cast<int>(identity.team)),
      "--attack",
      identity.imuStartsAt180 ? "left" : "right",
      "--particles",
      std::to_string(options.particles),
      "--field",
      fieldToText(m_scenario.settings.field)};
  if (const auto& game = m_simulation.state().game; game && game->teamOf(identity.team) >= 0) {
    const auto team = static_cast<std::size_t>(game->teamOf(identity.team));
    command.insert(command.end(),
                   {"--referee-team", std::to_string(game->teams[team].number), "--shirt",
                    std::to_string(identity.number), "--referee-port",
                    std::to_string(options.refereePort)});
  }
  if (m_thoughts) {
    command.insert(command.end(), {"--thoughts-port", std::to_string(m_thoughts->port())});
  }
  return command;
}

Result<void> SimulatedMatch::setBehaviour(RobotId id, const std::string& behaviour) {
  Seat* changed = seat(id);
  if (!changed) {
    return failure(ErrorCode::NotFound,
                   "there is no robot " + std::to_string(id.value) + " on the field");
  }
  const auto known = behaviours();
  if (behaviour != noBehaviour && std::none_of(known.begin(), known.end(), [&](const auto& b) {
        return b.name == behaviour;
      })) {
    std::vector<std::string_view> names;
    for (const BehaviourInfo& b : known) names.push_back(b.name);
    names.push_back(noBehaviour);
    return failure(ErrorCode::NotFound, unknownName("behaviour", behaviour, names));
  }
  const std::string before = std::exchange(changed->behaviour, behaviour);
  auto started = restartProcesses(*changed);
  if (!started) changed->behaviour = before;
  return started;
}

/// On failure inline processes go on as before.
Result<void> SimulatedMatch::restartProcesses(Seat& seat) {
  std::vector<InlineProcess> running = std::exchange(seat.processes, {});
  m_supervisor->stop(seat.id);
  auto started = startProcesses(seat);
  if (!started) seat.processes = std::move(running);
  return started;
}

Result<void> SimulatedMatch::setIdentity(const sim::RobotIdentity& identity) {
  Seat* changed = seat(identity.id);
  const auto index = m_simulation.indexOf(identity.id);
  if (!changed || !index) {
    return failure(ErrorCode::NotFound,
                   "there is no robot " + std::to_string(identity.id.value) + " on the field");
  }
  if (auto free = checkShirt(identity); !free) return free;
  sim::RobotIdentity& robot = m_simulation.editState().robots[*index];
  const sim::RobotIdentity before = std::exchange(robot, identity);
  auto started = restartProcesses(*changed);
  if (!started) robot = before;
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
    moment.robots.push_back(
        {robot.identity, {inside(robot.pose.position), robot.pose.yaw}, m_seats[i]->behaviour});
  }

  moment.writes =
      writesFrom(m_scenario.writes, now.time, [this](RobotId id) { return seat(id) != nullptr; });
  return moment;
}

}  // namespace pitchboard::link
