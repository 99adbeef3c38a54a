// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/simulation/simulation.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include <base/try.h>
#include <simcore/rules/published_rules.h>
#include <simcore/world/parameters.h>
#include <simcore/world/places.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::sim {
namespace {

tl::unexpected<Error> noSuchRobot(RobotId id) {
  return failure(ErrorCode::NotFound,
                 "There is no robot " + std::to_string(id.value) + " on the field.");
}

tl::unexpected<Error> noReferee() {
  return failure(ErrorCode::Conflict,
                 "This match has no referee; choose rules for it in the scenario or the Referee "
                 "dock.");
}

tl::unexpected<Error> noSuchPhysics(const std::string& name) {
  std::string known;
  for (const PhysicsModelInfo& model : physicsModels()) {
    known += (known.empty() ? "" : ", ") + std::string(model.name);
  }
  return failure(ErrorCode::NotFound,
                 "There is no physics model called \"" + name + "\". Known models: " + known + ".");
}

}  // namespace

std::vector<std::string> ignoredSettings(const SimulationSettings& settings,
                                         std::span<const RobotModel> models) {
  std::vector<std::string> ignored;
  if (settings.physics != "published") return ignored;
  const NoiseParameters& noise = settings.noise;
  const auto add = [&](bool asked, const char* sentence) {
    if (asked) ignored.emplace_back(sentence);
  };
  add(noise.imuWhite != 0.0, "The published physics has no white IMU noise (imu_white).");
  add(noise.missedDetection != 0.0,
      "The published physics always sees a ball or robot in view (missed_detection).");
  add(noise.visionDelay != 0.0, "The published physics has no vision delay (vision_delay).");
  add(noise.ofModel,
      "The published physics does not use the noise of robot models (noise \"robot\").");
  RigidBodySettings usual;
  usual.ballMass = settings.field.ballMass;
  add(!(settings.rigidBody == usual), "The published physics has fixed constants (rigid_body).");
  add(!(playedField(settings).surface == settings.field.surface),
      "The published physics has a fixed surface (rolling_deceleration, rolling_speed_kept).");
  add(std::ranges::any_of(models, [](const RobotModel& model) { return !(model == RobotModel{}); }),
      "The published physics has only one robot model (model).");
  add(settings.tickRate != published_frame::framesPerSecond,
      "The published physics has speeds per frame: at another tick rate than 60 everything moves "
      "faster or slower (tick_rate).");
  return ignored;
}

Simulation::Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::create(const SimulationSettings& settings) {
  TRY(validate(settings));
  Simulation simulation;
  simulation.m_model = makePhysicsModel(settings.physics);
  if (!simulation.m_model) return noSuchPhysics(settings.physics);
  simulation.m_state.settings = settings;
  simulation.m_model->reset(simulation.m_state);
  if (settings.referee) {
    TRY(simulation.setReferee(settings.referee));
  }
  simulation.makeRoom();
  return simulation;
}

void Simulation::makeRoom() {
  const std::size_t robots = robotCount();
  for (std::vector<Event>* events : {&m_events, &m_called}) events->reserve(4 * (robots + 4));
  m_placements.robots.reserve(2 * robots);
  m_seen.robots.reserve(robots);
}

void Simulation::step(std::span<const RobotCommand> commands, std::span<Percepts> percepts) {
  assert(commands.size() == robotCount() && percepts.size() == robotCount());
  m_events.clear();
  m_events.swap(m_called);
  m_eventsTaken = std::exchange(m_calledTaken, 0);
  const BallSweep sweep = m_model->move(m_state, commands, percepts, m_events);
  if (m_state.game) {
    snapshot(m_seen);
    m_placements.clear();
    stepReferee(m_state, m_seen, sweep, m_placements, m_events);
    carryOut();
  } else {
    applyPublishedRules(m_state, sweep, m_events);
  }
  m_model->sense(m_state, commands, percepts);
  ++m_state.tick;
  if (m_state.clockRunning) ++m_state.clockTicks;
}

void Simulation::carryOut() {
  if (m_placements.ball) (void)placeBall(*m_placements.ball);
  for (const auto& [index, pose] : m_placements.robots) {
    (void)placeRobot(m_state.robots[index].id, pose);
  }
}

Result<void> Simulation::call(const RefereeCall& call) {
  if (!m_state.game) return noReferee();
  snapshot(m_seen);
  m_placements.clear();
  TRY(callReferee(m_state, m_seen, call, m_placements, m_called));
  carryOut();
  return {};
}

std::span<const Event> Simulation::drainCalled() {
  return std::span(m_called).subspan(std::exchange(m_calledTaken, m_called.size()));
}

void Simulation::reportChanged(Setting setting, std::uint32_t cause) {
  m_called.push_back(
      {EventKind::SettingChanged, m_state.tick, {}, static_cast<int>(setting), cause});
}

void Simulation::reportUndone(std::uint32_t cause) {
  m_called.push_back({EventKind::Undone, m_state.tick, {}, static_cast<int>(cause), cause});
}

void Simulation::reportObeyed(const Game& before, bool joins) {
  sim::reportObeyed(before, joins, m_state, m_called);
}

Result<void> Simulation::setReferee(const std::optional<RefereeRules>& rules) {
  if (rules) {
    TRY(sim::validate(*rules));
  }
  const std::optional<RefereeRules> before = std::exchange(m_state.settings.referee, rules);
  if (!rules) {
    m_state.game.reset();
    m_state.refereeMemory = {};
    return {};
  }
  snapshot(m_seen);
  auto game = newGame(m_state, m_seen);
  if (!game) {
    m_state.settings.referee = before;
    return tl::unexpected(game.error());
  }
  m_state.game = std::move(*game);
  m_state.score = {};
  m_state.clockRunning = false;
  return {};
}

Result<void> Simulation::startGame(const GameStart& start) {
  if (!m_state.game) return noReferee();
  const WorldState before = m_state;
  auto begun = setReferee(before.settings.referee);
  m_placements.clear();
  if (begun) begun = sim::startGame(m_state, m_seen, start, m_placements, m_called);
  if (!begun) {
    m_state = before;
    return begun;
  }
  carryOut();
  return {};
}

Result<void> Simulation::restore(const WorldState& state) {
  TRY(validate(state.settings));
  if (state.settings.referee) {
    TRY(sim::validate(*state.settings.referee));
  }
  if (state.game && (!state.settings.referee ||
                     !isPlausible(*state.game, state.refereeMemory, state.robots.size()))) {
    return failure(ErrorCode::InvalidArgument,
                   "The saved state contains a game, but no referee rules are active.");
  }
  auto model = makePhysicsModel(state.settings.physics);
  const bool fits =
      state.models.size() == state.robots.size() && state.statistics.size() == state.robots.size();
  for (const RobotModel& robot : state.models) {
    TRY(validate(robot));
  }
  if (!fits || !model || !model->owns(state)) {
    return failure(ErrorCode::InvalidArgument, "The saved state does not fit its physics model.");
  }
  m_state = state;
  m_model = std::move(model);
  m_events.clear();
  m_called.clear();
  m_eventsTaken = m_calledTaken = 0;
  makeRoom();
  return {};
}

void Simulation::exchange(WorldCourse& course) {
  assert(!m_state.game && course.statistics.size() == robotCount());
  std::swap(m_state.settings.seed, course.seed);
  std::swap(m_state.tick, course.tick);
  std::swap(m_state.score, course.score);
  std::swap(m_state.clockRunning, course.clockRunning);
  std::swap(m_state.clockTicks, course.clockTicks);
  m_state.statistics.swap(course.statistics);
  m_state.physics.swap(course.physics);
}

void Simulation::snapshot(Snapshot& out) const {
  out.tick = m_state.tick;
  out.time = static_cast<double>(m_state.tick) / m_state.settings.tickRate;
  out.clock = static_cast<double>(m_state.clockTicks) / m_state.settings.tickRate;
  out.clockRunning = m_state.clockRunning;
  out.score = m_state.score;
  out.robots.resize(robotCount());
  static const RobotModel theUsual;
  const bool knowsModels = m_state.settings.physics != "published";
  for (std::size_t i = 0; i < robotCount(); ++i) {
    out.robots[i].identity = m_state.robots[i];
    out.robots[i].statistics = m_state.statistics[i];
    const RobotModel& model = knowsModels ? m_state.models[i] : theUsual;
    out.robots[i].radius = model.radius;
    out.robots[i].fieldOfView = model.fieldOfView;
    out.robots[i].visionRange = model.visionRange;
  }
  m_model->describe(m_state, out);
}

Snapshot Simulation::snapshot() const {
  Snapshot out;
  snapshot(out);
  return out;
}

std::optional<std::size_t> Simulation::indexOf(RobotId id) const {
  for (std::size_t i = 0; i < robotCount(); ++i) {
    if (m_state.robots[i].id == id) return i;
  }
  return {};
}

std::optional<Pose> Simulation::robotPose(RobotId id) const {
  const auto index = indexOf(id);
  if (!index) return {};
  return m_model->robotPose(m_state, *index);
}

Result<void> Simulation::addRobot(const RobotIdentity& identity, const Pose& pose,
                                  const RobotModel& model) {
  if (identity.id.value < 1 || identity.id.value > maxRobots) {
    return failure(ErrorCode::InvalidArgument,
                   "Robot numbers lie between 1 and " + std::to_string(maxRobots) + ".");
  }
  if (indexOf(identity.id)) {
    return failure(ErrorCode::Conflict,
                   "Robot " + std::to_string(identity.id.value) + " is already on the field.");
  }
  if (!isFinite(pose)) {
    return failure(ErrorCode::InvalidArgument, "A robot's pose must be finite numbers.");
  }
  if (m_state.game) TRY(checkTeam(*m_state.game, identity.team));
  TRY(validate(model));
  m_state.robots.push_back(identity);
  m_state.models.push_back(model);
  m_state.statistics.emplace_back();
  if (m_state.game) m_state.refereeMemory.watches.emplace_back();
  const double radius = robotRadius(m_state, robotCount() - 1);
  m_model->robotAdded(m_state,
                      {insideWalls(m_state.settings.field, pose.position, radius), pose.yaw});
  m_model->settingsChanged(m_state);
  makeRoom();
  return {};
}

Result<void> Simulation::removeRobot(RobotId id) {
  const auto index = indexOf(id);
  if (!index) return noSuchRobot(id);
  const auto offset = static_cast<std::ptrdiff_t>(*index);
  m_state.robots.erase(m_state.robots.begin() + offset);
  m_state.models.erase(m_state.models.begin() + offset);
  m_state.statistics.erase(m_state.statistics.begin() + offset);
  if (m_state.game)
    m_state.refereeMemory.watches.erase(m_state.refereeMemory.watches.begin() + offset);
  m_model->robotRemoved(m_state, *index);
  m_model->settingsChanged(m_state);
  return {};
}

Result<void> Simulation::placeRobot(RobotId id, const Pose& pose) {
  const auto index = indexOf(id);
  if (!index) return noSuchRobot(id);
  if (!isFinite(pose)) {
    return failure(ErrorCode::InvalidArgument, "A robot's pose must be finite numbers.");
  }
  const double radius = robotRadius(m_state, *index);
  m_model->placeRobot(m_state, *index,
                      {insideWalls(m_state.settings.field, pose.position, radius), pose.yaw});
  return {};
}

Result<void> Simulation::placeHead(RobotId id, double headYaw) {
  const auto index = indexOf(id);
  if (!index) return noSuchRobot(id);
  if (!std::isfinite(headYaw)) {
    return failure(ErrorCode::InvalidArgument, "A head direction must be a finite number.");
  }
  m_model->placeHead(m_state, *index, headYaw);
  return {};
}

Result<void> Simulation::placeBall(const Point& position, const Velocity& velocity) {
  if (!isFinite({position, 0}) || !isFinite({{velocity.x, velocity.y}, 0})) {
    return failure(ErrorCode::InvalidArgument, "The ball's position must be finite numbers.");
  }
  const FieldSpec& field = m_state.settings.field;
  m_model->placeBall(m_state, insideWalls(field, position, field.ballRadius), velocity);
  return {};
}

Result<void> Simulation::setNoise(const NoiseParameters& noise) {
  TRY(validate(noise));
  m_state.settings.noise = noise;
  m_model->settingsChanged(m_state);
  return {};
}

Result<void> Simulation::setRobotModel(RobotId id, const RobotModel& model) {
  const auto index = indexOf(id);
  if (!index) return noSuchRobot(id);
  TRY(validate(model));
  m_state.models[*index] = model;
  m_model->settingsChanged(m_state);
  return {};
}

Result<void> Simulation::setRigidBody(const RigidBodySettings& settings) {
  TRY(validate(settings));
  m_state.settings.rigidBody = settings;
  m_model->settingsChanged(m_state);
  return {};
}

Result<void> Simulation::setPhysics(const std::string& name) {
  if (name == m_state.settings.physics) return {};
  auto model = makePhysicsModel(name);
  if (!model) return noSuchPhysics(name);
  const Snapshot now = snapshot();
  std::vector<double> imuErrors;
  for (std::size_t i = 0; i < robotCount(); ++i) imuErrors.push_back(m_model->imuError(m_state, i));
  m_model = std::move(model);
  m_state.settings.physics = name;
  m_model->reset(m_state);
  const FieldSpec& field = m_state.settings.field;
  for (std::size_t i = 0; i < robotCount(); ++i) {
    const RobotSnapshot& robot = now.robots[i];
    const Point place = insideWalls(field, robot.pose.position, robotRadius(m_state, i));
    m_model->robotAdded(m_state, {place, robot.pose.yaw});
    m_model->placeHead(m_state, i, robot.headYaw);
    m_model->setImuError(m_state, i, imuErrors[i]);
  }
  m_model->placeBall(m_state, insideWalls(field, now.ball, field.ballRadius), now.ballVelocity);
  m_model->settingsChanged(m_state);
  return {};
}

}  // namespace pitchboard::sim
