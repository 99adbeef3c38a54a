// SPDX-License-Identifier: GPL-3.0-or-later
#include "rollout_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>
#include <base/try.h>
#include <simcore/world/action.h>
#include <simcore/world/gait_step.h>
#include <simcore/world/parameters.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::rollout {
namespace {

using link::Act;
using link::SoccerPlayer;
using std::numbers::pi;

constexpr double cycleTime = SoccerPlayer::period;
constexpr double lyingTime = 0.5;  // s until control notices, as in the rigid-body model
constexpr int getUpFromFront = 15, getUpFromBack = 16;
constexpr double pointingTolerance = pi / 180.0;
constexpr double pushesPerSecond = 60.0;
constexpr double partingSpeed = 0.5;  // m/s at which things placed onto each other part
constexpr int reminders = 9;          // cycles until a mind has looked for opponents
constexpr int talkCycles = 2;

double nan() {
  return std::numeric_limits<double>::quiet_NaN();
}

double approached(double dx, double dy) {
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

Result<std::shared_ptr<const RolloutConstants>> RolloutConstants::create(const Setup& setup) {
  TRY(sim::validate(setup.field));
  const auto refuse = [](const std::string& text, const char* key) {
    return failure(ErrorCode::InvalidArgument, text, key);
  };
  if (setup.players.empty() || setup.players.size() > Rollouts::mostPlayers) {
    return refuse("A rollout has 1 to " + std::to_string(Rollouts::mostPlayers) + " players.",
                  "players");
  }
  const double perCycle = setup.tickRate * cycleTime;
  if (!(perCycle >= 1.0 && perCycle <= 12.0) || perCycle != std::floor(perCycle)) {
    return refuse("The tick rate must be a multiple of 10 between 10 and 120.", "tick_rate");
  }
  auto made = std::make_shared<RolloutConstants>();
  made->setup = setup;
  made->ticksPerCycle = static_cast<int>(perCycle);
  made->dt = cycleTime / perCycle;
  made->sqrtFrames = std::sqrt(sim::published_frame::framesPerSecond * made->dt);
  made->rolling = sim::rollingShare(setup.field.surface.keptPerFrame, made->dt);
  made->drawsPerCycle = std::max(6, 3 * made->ticksPerCycle);
  const int players = static_cast<int>(setup.players.size());
  double longestDelay = 0.0;
  for (const Player& player : made->setup.players) {
    link::SoccerPlayerOptions options;
    options.field = setup.field;
    options.model = player.model;
    options.behaviour = player.behaviour;
    options.facesLeft = player.side == Side::Right;
    made->fresh.push_back(TRY(SoccerPlayer::create(options)));
    Of of;
    of.model = &player.model;
    of.noise = setup.noise.ofModel ? player.model.noise : setup.noise;
    of.belief = beliefNoise(of.noise);
    of.radius = player.model.radius > 0.0 ? player.model.radius : setup.field.robotRadius;
    of.delayTicks = of.noise.visionDelay / made->dt;
    longestDelay = std::max(longestDelay, of.delayTicks);
    made->players.push_back(of);
  }
  made->moments = static_cast<std::size_t>(longestDelay) + 2;
  for (int i = 1; i <= players; ++i) made->drawers.push_back(i);
  for (int i = 1; i <= players; ++i) made->drawers.push_back(1000 + i);
  return std::shared_ptr<const RolloutConstants>(std::move(made));
}

Result<RolloutWorld> RolloutWorld::create(std::shared_ptr<const RolloutConstants> constants) {
  RolloutWorld world;
  const Setup& setup = constants->setup;
  for (std::size_t i = 0; i < setup.players.size(); ++i) {
    link::SoccerPlayerOptions options;
    options.field = setup.field;
    options.model = setup.players[i].model;
    options.behaviour = setup.players[i].behaviour;
    options.facesLeft = setup.players[i].side == Side::Right;
    world.m_minds.push_back(TRY(SoccerPlayer::create(options)));
  }
  world.m_pastBalls.resize(constants->moments);
  world.m_pastBodies.resize(constants->moments * setup.players.size());
  world.m_motionNoise.reserve(setup.players.size());
  world.m_constants = std::move(constants);
  return world;
}

// The beginning.

void RolloutWorld::begin(const Belief& belief, std::uint64_t seed, const PlayOptions& options,
                         std::span<TracePoint> trace) {
  m_seed = seed;
  m_tick = m_cycle = 0;
  m_goOn = options.goOn;
  m_advice = options.advice;
  m_advised = options.advised;
  m_game = belief.game;
  const double seconds = std::min(options.seconds, std::max(0.0, belief.game.secondsLeft));
  m_lastTick = static_cast<std::uint64_t>(std::llround(seconds / m_constants->dt));
  m_lookTick = static_cast<std::uint64_t>(std::llround(options.look / m_constants->dt));
  m_ended = Ended::Time;
  m_over = m_looked = false;
  m_goalsLeft = m_goalsRight = 0;
  m_lastTouch = -1;
  m_timeToGoal = nan();
  m_here.clear();
  for (std::size_t i = 0; i < belief.robots.size(); ++i) {
    if (!belief.robots[i].absent) m_here.push_back(i);
  }
  sample(belief);
  m_setPlayBall = m_ball;
  m_trace = trace;
  m_traced = 0;
  m_traceTicks = options.traceEvery / m_constants->dt;
  traceUntil(1);
  remindOf(belief);
  for (std::size_t ago = 0; ago < m_constants->moments; ++ago) {
    m_tick = ago;
    remember();
  }
  m_tick = 0;
}

void RolloutWorld::sample(const Belief& belief) {
  for (const std::size_t i : m_here) {
    const RobotBelief& known = belief.robots[i];
    CounterRandom random(m_seed, static_cast<int>(i) + 1, NoiseStream::Behaviour, 0);
    Body& body = m_bodies[i];
    body = {};
    body.pose.position.x = random.normal(known.pose.position.x, known.sigma);
    body.pose.position.y = random.normal(known.pose.position.y, known.sigma);
    body.pose.yaw = wrapToPi(random.normal(known.pose.yaw, known.yawSigma));
    const auto [s, c] = repeatable::sinCos(body.pose.yaw);
    body.cos = c;
    body.sin = s;
    body.forward = known.forward;
    body.left = known.left;
    body.turn = known.turn;
    body.error = {known.pose.position.x - body.pose.position.x,
                  known.pose.position.y - body.pose.position.y};
    body.yawError = wrapToPi(known.pose.yaw - body.pose.yaw);
    body.sigma = std::max(known.sigma, of(i).belief.place.told);
    if (known.down) {
      body.posture = sim::Posture::GettingUp;
      body.action = {getUpFromFront, 0};
      body.getUpLeft = known.getsUpIn;
    }
  }
  CounterRandom random(m_seed, 0, NoiseStream::Behaviour, 0);
  const BallBelief& ball = belief.ball;
  m_ball.x = random.normal(ball.place.x, ball.sigma);
  m_ball.y = random.normal(ball.place.y, ball.sigma);
  m_ballVelocity.x = random.normal(ball.velocity.x, ball.velocitySigma);
  m_ballVelocity.y = random.normal(ball.velocity.y, ball.velocitySigma);
  const double dt = m_constants->dt;
  for (double rolled = 0.0; rolled + dt / 2 < ball.age; rolled += dt) {
    const double speed = approached(m_ballVelocity.x, m_ballVelocity.y);
    const auto [mean, left] = sim::rolledOf(field().surface, m_constants->rolling, speed, dt);
    if (left <= 0.0 && mean <= 0.0) break;
    m_ball.x += m_ballVelocity.x * mean * dt;
    m_ball.y += m_ballVelocity.y * mean * dt;
    m_ballVelocity = {m_ballVelocity.x * left, m_ballVelocity.y * left};
  }
  m_ball.x = std::clamp(m_ball.x, -field().halfLength(), field().halfLength());
  m_ball.y = std::clamp(m_ball.y, -field().halfWidth(), field().halfWidth());
}

/// Every mind has seen, in the second before, what was in front of it: the ball where it is
/// believed to have rolled, then opponents.
void RolloutWorld::remindOf(const Belief& belief) {
  const BallBelief& ball = belief.ball;
  std::array<std::size_t, 2> first{most, most};  // at the ball
  std::array<double, 2> least{1e9, 1e9};
  for (const std::size_t i : m_here) {
    const auto side = static_cast<std::size_t>(sideOf(i));
    const double way = distance(belief.robots[i].pose.position, ball.place);
    if (way >= least[side] || m_constants->setup.players[i].behaviour.name == "keeper") continue;
    least[side] = way;
    first[side] = i;
  }
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    const sim::RobotModel& model = *of(i).model;
    const Pose& pose = belief.robots[i].pose;
    const double widest = model.panLimit + model.fieldOfView / 2.0;
    const auto seen = [&](const Point& place) -> std::optional<link::SeenAt> {
      const double away = distance(pose.position, place);
      const double bearing = wrapToPi(direction(pose.position, place) - pose.yaw);
      if (away > model.visionRange || away <= 0.0 || std::abs(bearing) > widest) return {};
      return link::SeenAt{away, bearing};
    };
    body.head = std::clamp(wrapToPi(direction(pose.position, ball.place) - pose.yaw),
                           -model.panLimit, model.panLimit);
    const bool isKeeper = m_constants->setup.players[i].behaviour.name == "keeper";
    m_says[i] = {pose.position,
                 isKeeper                                          ? link::Intention::Keep
                 : first[static_cast<std::size_t>(sideOf(i))] == i ? link::Intention::Ball
                                                                   : link::Intention::Support,
                 !body.isDown(),
                 {}};

    link::SoccerPlayer& mind = m_minds[i];
    mind.copyMind(m_constants->fresh[i]);
    m_input = {};
    m_input.believed = pose;
    m_input.sigma = body.sigma;
    m_input.imuYaw = wrapToPi(pose.yaw - (sideOf(i) == Side::Right ? pi : 0.0));
    for (const std::size_t other : m_here) {
      if (sideOf(other) == sideOf(i)) continue;
      // While it looked at the ball.
      const auto at = seen(belief.robots[other].pose.position);
      const bool inView =
          at && std::abs(wrapToPi(at->bearing - body.head)) < model.fieldOfView / 2.0;
      if (inView) m_input.robots[other] = at;
    }
    for (int k = 1; k <= reminders; ++k) {
      const double ago = cycleTime * (reminders - k);
      const Point was{ball.place.x - ball.velocity.x * ago, ball.place.y - ball.velocity.y * ago};
      m_input.ball = seen(was);
      if (m_input.ball && k == reminders - 1) m_says[i].ball = was;
      mind.observe(m_input, -ball.age - ago);
    }
  }
}

// A cycle: what the robots see, believe, say and decide.

bool RolloutWorld::cycle() {
  if (m_over || m_tick >= m_lastTick) return false;
  decide();
  for (int k = 0; k < m_constants->ticksPerCycle && !m_over && m_tick < m_lastTick; ++k) tick();
  ++m_cycle;
  return !m_over && m_tick < m_lastTick;
}

void RolloutWorld::decide() {
  const RolloutConstants& constants = *m_constants;
  m_noise.make(m_seed, NoiseStream::Motion, m_cycle + 1, constants.drawers,
               constants.drawsPerCycle);
  m_motionNoise.clear();
  const std::size_t players = constants.players.size();
  for (std::size_t i = 0; i < players; ++i) m_motionNoise.push_back(m_noise.of(i));
  if (m_cycle % talkCycles == 0) talk();
  if (m_game.setPlay != sim::SetPlay::None) {
    constexpr double taken = 0.1;  // m
    m_game.setPlayLeft -= cycleTime;
    if (m_game.setPlayLeft < 0.0 || distance(m_ball, m_setPlayBall) > taken) {
      m_game.setPlay = sim::SetPlay::None;
    }
  }
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    RandomBatch::Draws draws = m_noise.of(players + i);
    drift(i, draws);
    m_input.referee = wordFor(i);
    m_input.fallen = body.isDown();
    m_input.setPlay = m_game.setPlay;
    m_input.setPlayIsOurs = m_game.setPlaySide == sideOf(i);
    m_input.believed = believed(i);
    m_input.sigma = body.sigma;
    m_input.imuYaw = wrapToPi(m_input.believed.yaw - (sideOf(i) == Side::Right ? pi : 0.0));
    m_input.doing = {body.isDown() ? body.action.action : body.command.action, body.command.b};
    const bool isAdvised = i == m_advised && m_advice.kind != link::AdviceKind::None;
    m_input.advice = isAdvised ? m_advice : link::Advice{};
    m_input.adviceStamp = isAdvised ? static_cast<int>(m_cycle) + 1 : 0;
    look(i, draws);
    listen(i);
    const link::PlayerDecision decision = m_minds[i].step(m_input, now());
    body.command = decision.act;
    body.search = body.search || decision.search;
    body.looksForOpponents = decision.looksForOpponents;
    m_says[i] = {m_input.believed.position, decision.intention, !body.isDown(), decision.ball};
  }
}

void RolloutWorld::drift(std::size_t i, RandomBatch::Draws& draws) {
  Body& body = m_bodies[i];
  const BeliefNoise& noise = of(i).belief;
  body.error.x = noise.place.step(body.error.x, cycleTime, body.inMotion, draws.normal(0.0, 1.0));
  body.error.y = noise.place.step(body.error.y, cycleTime, body.inMotion, draws.normal(0.0, 1.0));
  body.yawError = noise.yaw.step(body.yawError, cycleTime, body.inMotion, draws.normal(0.0, 1.0));
  body.sigma += noise.place.gain * cycleTime * (noise.place.told - body.sigma);
}

Pose RolloutWorld::believed(std::size_t i) const {
  const Body& body = m_bodies[i];
  return {{body.pose.position.x + body.error.x, body.pose.position.y + body.error.y},
          wrapToPi(body.pose.yaw + body.yawError)};
}

void RolloutWorld::searchWithHead(std::size_t i) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const double step = model.headSpeed * cycleTime;
  body.head += body.panRight ? -step : step;
  if (std::abs(body.head) < model.panLimit) return;
  body.head = std::clamp(body.head, -model.panLimit, model.panLimit);
  body.panRight = body.head > 0.0;
}

void RolloutWorld::look(std::size_t i, RandomBatch::Draws& draws) {
  Body& body = m_bodies[i];
  m_input.ball.reset();
  if (body.looksForOpponents) m_input.robots = {};
  if (body.isDown()) return;
  if (body.search) searchWithHead(i);
  const Seen image = bodySeen(of(i).delayTicks, i);
  const double ahead = of(i).model->cameraForward;
  const Point lens{image.pose.position.x + ahead * image.cos,
                   image.pose.position.y + ahead * image.sin};
  if (body.looksForOpponents) {
    lookAtOpponents(i, image, lens);
  } else {
    lookAtBall(i, image, lens, draws);
  }
}

void RolloutWorld::lookAtBall(std::size_t i, const Seen& image, const Point& lens,
                              RandomBatch::Draws& draws) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const sim::NoiseParameters& noise = of(i).noise;
  const Point ball = ballSeen(of(i).delayTicks);
  double dx = ball.x - lens.x, dy = ball.y - lens.y;
  if (dx * dx + dy * dy >= model.visionRange * model.visionRange) return;
  double bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
  if (std::abs(wrapToPi(bearing - image.head)) >= model.fieldOfView / 2.0) return;
  if (draws.uniform() < noise.missedDetection) return;
  double away = approached(dx, dy);
  if (model.fromCamera) {
    away = approached(away, model.cameraHeight - field().ballRadius);
  } else if (model.cameraForward != 0.0) {
    dx = ball.x - image.pose.position.x;
    dy = ball.y - image.pose.position.y;
    away = approached(dx, dy);
    bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
  }
  away = std::max(0.0, draws.normal(away, noise.visionDistance * away));
  bearing = wrapToPi(draws.normal(bearing, noise.visionBearing));
  const double goal = std::clamp(bearing, -model.panLimit, model.panLimit);
  const double step = model.headSpeed * cycleTime;
  body.panRight = goal < body.head;
  body.head += std::clamp(goal - body.head, -step, step);
  if (std::abs(goal - body.head) <= pointingTolerance) body.search = false;
  if (away > 0.0) m_input.ball = link::SeenAt{away, bearing};
}

void RolloutWorld::lookAtOpponents(std::size_t i, const Seen& image, const Point& lens) {
  const sim::RobotModel& model = *of(i).model;
  const sim::NoiseParameters& noise = of(i).noise;
  CounterRandom random(m_seed, static_cast<int>(i) + 1, NoiseStream::RobotVision, m_cycle);
  for (const std::size_t other : m_here) {
    if (sideOf(other) == sideOf(i)) continue;
    const Point& place = bodyAt(static_cast<std::size_t>(of(i).delayTicks), other).pose.position;
    const double dx = place.x - lens.x, dy = place.y - lens.y;
    if (dx * dx + dy * dy >= model.visionRange * model.visionRange) continue;
    const double bearing = wrapToPi(repeatable::atan2(dy, dx) - image.pose.yaw);
    if (std::abs(wrapToPi(bearing - image.head)) >= model.fieldOfView / 2.0) continue;
    // Some frame of the cycle shows it, so that none is missed.
    const Point from = image.pose.position;
    const double away = random.normal(distance(from, place), noise.robotDistance);
    const double seen =
        random.normal(wrapToPi(direction(from, place) - image.pose.yaw), noise.robotBearing);
    if (away > 0.0) m_input.robots[other] = link::SeenAt{away, wrapToPi(seen)};
  }
}

void RolloutWorld::talk() {
  for (const std::size_t i : m_here) m_told[i] = m_says[i];
}

/// All team-mates; of many those who go for the ball, then those who see it, then the nearest.
void RolloutWorld::listen(std::size_t i) {
  m_input.matePlaces.clear();
  InlineVector<std::size_t, most> mates;
  for (const std::size_t other : m_here) {
    if (other == i || sideOf(other) != sideOf(i)) continue;
    mates.push_back(other);
    m_input.matePlaces.push_back(m_told[other].place);
  }
  if (mates.size() > link::mostTeamMates) {
    const auto rank = [&](std::size_t mate) {
      const Told& told = m_told[mate];
      return std::tuple(told.intention == link::Intention::Ball ? 0 : 1, told.ball ? 0 : 1,
                        distance(told.place, m_input.believed.position), mate);
    };
    std::sort(mates.begin(), mates.end(),
              [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    mates.shrink(link::mostTeamMates);
    std::sort(mates.begin(), mates.end());
  }
  for (std::size_t k = 0; k < m_input.mates.size(); ++k) {
    m_input.mates[k].reset();
    if (k >= mates.size()) continue;
    const Told& told = m_told[mates[k]];
    m_input.mates[k] = link::TeamMate{told.place, told.intention, told.upright, told.ball};
  }
}

link::Referee RolloutWorld::wordFor(std::size_t i) const {
  switch (m_game.state) {
    case sim::PlayState::Playing:
      return m_game.setPlay != sim::SetPlay::None && m_game.setPlaySide != sideOf(i)
                 ? link::Referee::Ready
                 : link::Referee::Play;
    case sim::PlayState::Ready:
      return link::Referee::Ready;
    case sim::PlayState::Set:
      return link::Referee::Set;
    case sim::PlayState::Initial:
    case sim::PlayState::Finished:
      break;
  }
  return link::Referee::Stop;
}

// A tick: control, bodies, ball.

void RolloutWorld::tick() {
  for (const std::size_t i : m_here) {
    control(i);
    walk(i);
  }
  collide();
  const Point before = m_ball;
  rollBall();
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    if (!body.touched) continue;
    const double grip = sim::feetGrip * m_constants->dt;
    body.forward =
        sim::afterContact(body.forward, body.cos * body.pushed.x + body.sin * body.pushed.y, grip);
    body.left =
        sim::afterContact(body.left, body.cos * body.pushed.y - body.sin * body.pushed.x, grip);
    if (m_constants->setup.body.falls && !body.isDown()) {
      const sim::RobotModel& model = *of(i).model;
      const double hit = sim::tippingShare * model.mass * approached(body.pushed.x, body.pushed.y);
      if (hit > model.fallImpulse) {
        const double along = body.pushed.x * body.cos + body.pushed.y * body.sin;
        body.posture = along > 0.0 ? sim::Posture::OnFront : sim::Posture::OnBack;
        body.getUpLeft = lyingTime;
        body.kickElapsed = -1.0;
        select(body, 0, 0, false);
      }
    }
  }
  ++m_tick;
  judge(before);
  remember();
  if (m_traced < m_trace.size()) {
    constexpr double rounding = 1e-6;  // ticks
    traceUntil(static_cast<std::size_t>((static_cast<double>(m_tick) + rounding) / m_traceTicks) +
               1);
  }
}

void RolloutWorld::select(Body& body, int code, int b, bool inMotion) const {
  body.action = {code, b};
  body.inMotion = inMotion;
}

void RolloutWorld::control(std::size_t i) {
  Body& body = m_bodies[i];
  if (body.isDown()) {
    stepDown(i);
    return;
  }
  if (body.kickElapsed >= 0.0) {
    stepKick(i);
    return;
  }
  if (body.action.action == body.command.action) return;
  const sim::Action* action = sim::findAction(body.command.action);
  if (action == nullptr) {
    select(body, body.command.action, body.command.b, false);
    return;
  }
  switch (action->kind) {
    case ActionKind::Stop:
    case ActionKind::GetUp:
      select(body, action->code, body.command.b, false);
      break;
    case ActionKind::Walk:
    case ActionKind::InPlace:
      select(body, action->code, body.command.b, true);
      break;
    case ActionKind::Kick:
      if (of(i).model->kickTime > 0.0) {
        select(body, action->code, 0, false);
        body.kickElapsed = 0.0;
        break;
      }
      kick(i, action->code);
      select(body, 0, 0, false);
      body.command = {};
      break;
  }
}

void RolloutWorld::stepDown(std::size_t i) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  body.getUpLeft -= m_constants->dt;
  if (body.getUpLeft > 0.0) return;
  if (body.posture == sim::Posture::GettingUp) {
    body.posture = sim::Posture::Upright;
    body.getUpLeft = 0.0;
    select(body, 0, 0, false);
    return;
  }
  const bool front = body.posture == sim::Posture::OnFront;
  select(body, front ? getUpFromFront : getUpFromBack, 0, false);
  body.posture = sim::Posture::GettingUp;
  body.getUpLeft = front ? model.getUpFront : model.getUpBack;
}

void RolloutWorld::stepKick(std::size_t i) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const double contact = std::min(model.kickContact, model.kickTime);
  const double before = body.kickElapsed;
  body.kickElapsed += m_constants->dt;
  if (before <= contact && body.kickElapsed > contact) kick(i, body.action.action);
  if (body.kickElapsed < model.kickTime) return;
  body.kickElapsed = -1.0;
  if (body.command.action == body.action.action) body.command = {};
  select(body, 0, 0, false);
}

void RolloutWorld::kick(std::size_t i, int code) {
  const Body& body = m_bodies[i];
  const double dx = m_ball.x - body.pose.position.x, dy = m_ball.y - body.pose.position.y;
  const sim::BallAtFeet ball{approached(dx, dy),
                             wrapToPi(repeatable::atan2(dy, dx) - body.pose.yaw)};
  const double hit = sim::kickSpeed(*of(i).model, of(i).radius, code, ball);
  if (hit <= 0.0) return;
  const sim::NoiseParameters& noise = of(i).noise;
  CounterRandom random(m_seed, static_cast<int>(i) + 1, NoiseStream::Kick, m_tick);
  const double speed = std::max(0.0, random.normal(hit, noise.kickSpeed));
  const double turned = radiansFromDegrees(sim::findAction(code)->kick.direction);
  const auto [s, c] = repeatable::sinCos(random.normal(body.pose.yaw + turned, noise.kickAngle));
  m_ballVelocity = {speed * c, speed * s};
  m_lastTouch = static_cast<int>(i);
}

void RolloutWorld::walk(std::size_t i) {
  Body& body = m_bodies[i];
  const sim::RobotModel& model = *of(i).model;
  const sim::NoiseParameters& noise = of(i).noise;
  const double dt = m_constants->dt;
  const sim::GaitSpeed target =
      body.inMotion ? sim::gaitSpeed(model, body.action.action, body.action.b) : sim::GaitSpeed{};
  body.forward = sim::approach(body.forward, target.forward, model.maxAcceleration * dt);
  body.left = sim::approach(body.left, target.left, model.maxAcceleration * dt);
  body.turn = sim::approach(body.turn, target.turn, model.maxYawAcceleration * dt);
  double turned = body.turn * dt, ahead = body.forward * dt, aside = body.left * dt;
  if (body.inMotion) {
    const double scale = m_constants->sqrtFrames;
    turned += m_motionNoise[i].normal(0.0, noise.rotation * scale);
    ahead += m_motionNoise[i].normal(0.0, noise.forward * scale);
    aside += m_motionNoise[i].normal(0.0, noise.sideways * scale);
  }
  if (turned != 0.0) {
    body.pose.yaw = wrapToPi(body.pose.yaw + turned);
    const auto [s, c] = repeatable::sinCos(body.pose.yaw);
    body.cos = c;
    body.sin = s;
  }
  body.velocity = {body.cos * body.forward - body.sin * body.left,
                   body.sin * body.forward + body.cos * body.left};
  body.pose.position.x += body.cos * ahead - body.sin * aside;
  body.pose.position.y += body.sin * ahead + body.cos * aside;
  body.pushed = {};
  body.touched = false;
}

/// `away`: from the other to robot i; `into`: m/s at which the two meet; an infinite mass stands.
void RolloutWorld::push(std::size_t i, const Point& away, double depth, double into,
                        double otherMass) {
  Body& body = m_bodies[i];
  const double mass = of(i).model->mass;
  const double share = std::isinf(otherMass) ? 1.0 : otherMass / (mass + otherMass);
  body.pose.position.x += away.x * depth * share;
  body.pose.position.y += away.y * depth * share;
  if (into <= 0.0) return;
  body.pushed.x += away.x * into * share;
  body.pushed.y += away.y * into * share;
  body.touched = true;
}

/// Robots against each other, posts and walls.
void RolloutWorld::collide() {
  const double parting = partingSpeed * m_constants->dt;
  constexpr double stands = std::numeric_limits<double>::infinity();
  for (std::size_t a = 1; a < m_here.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const std::size_t i = m_here[a], j = m_here[b];
      Body& one = m_bodies[i];
      Body& other = m_bodies[j];
      const double dx = one.pose.position.x - other.pose.position.x;
      const double dy = one.pose.position.y - other.pose.position.y;
      const double touching = of(i).radius + of(j).radius;
      if (dx * dx + dy * dy >= touching * touching) continue;
      const double way = approached(dx, dy);
      const Point away = way > 0.0 ? Point{dx / way, dy / way} : Point{1.0, 0.0};
      const double into = (other.velocity.x - one.velocity.x) * away.x +
                          (other.velocity.y - one.velocity.y) * away.y;
      const double depth = std::min(touching - way, parting);
      push(i, away, depth, into, of(j).model->mass);
      push(j, {-away.x, -away.y}, depth, into, of(i).model->mass);
    }
  }
  const sim::FieldSpec& f = field();
  const double nearPosts = f.halfLength() - f.goalPostRadius;
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    Point& at = body.pose.position;
    const double radius = of(i).radius;
    if (std::abs(at.x) + radius > nearPosts) {
      const double touching = radius + f.goalPostRadius;
      const double x = std::copysign(f.halfLength(), at.x);
      const double y = std::copysign(f.goalWidth / 2.0, at.y);
      const double dx = at.x - x, dy = at.y - y;
      if (dx * dx + dy * dy < touching * touching) {
        const double way = approached(dx, dy);
        const Point away = way > 0.0 ? Point{dx / way, dy / way} : Point{-1.0, 0.0};
        push(i, away, std::min(touching - way, parting),
             -(body.velocity.x * away.x + body.velocity.y * away.y), stands);
      }
    }
    const double wallX = f.halfLength() + f.border - radius;
    const double wallY = f.halfWidth() + f.border - radius;
    at = {std::clamp(at.x, -wallX, wallX), std::clamp(at.y, -wallY, wallY)};
  }
}

/// When on its way the ball's centre comes so near to a circle; a ball that lies in it is no hit.
bool RolloutWorld::ballHits(const Point& at, double radius, const Point& way, double& share) const {
  const double dx = m_ball.x - at.x, dy = m_ball.y - at.y;
  const double towards = dx * way.x + dy * way.y;
  if (towards >= 0.0) return false;
  const double apart = dx * dx + dy * dy - radius * radius;
  const double length2 = way.x * way.x + way.y * way.y;
  const double root = towards * towards - length2 * apart;
  if (root < 0.0) return false;
  const double when = apart <= 0.0 ? 0.0 : (-towards - std::sqrt(root)) / length2;
  if (when >= share) return false;
  share = when;
  return true;
}

/// Off a thing at `at` that moves, or stands.
void RolloutWorld::bounce(const Point& at, const Velocity& moving, double robotMass,
                          double restitution, Velocity& velocity) {
  const double dx = m_ball.x - at.x, dy = m_ball.y - at.y;
  const double way = approached(dx, dy);
  const Point away = way > 0.0 ? Point{dx / way, dy / way} : Point{1.0, 0.0};
  const double into = (moving.x - velocity.x) * away.x + (moving.y - velocity.y) * away.y;  // m/s
  if (into <= 0.0) return;
  const double kept = into > sim::bouncesFrom ? 1.0 + restitution : 1.0;
  const double share = robotMass / (robotMass + m_constants->setup.body.ballMass);
  velocity.x += away.x * into * kept * share;
  velocity.y += away.y * into * kept * share;
}

void RolloutWorld::rollBall() {
  const RolloutConstants& constants = *m_constants;
  const sim::FieldSpec& f = field();
  const double dt = constants.dt;
  const double speed = approached(m_ballVelocity.x, m_ballVelocity.y);
  const auto [mean, left] = sim::rolledOf(f.surface, constants.rolling, speed, dt);
  Velocity velocity{m_ballVelocity.x * mean, m_ballVelocity.y * mean};
  constexpr double post = 1e9;  // kg
  const double restitution = constants.setup.body.robotRestitution;

  // Robots that walk into it take it along, and are slowed down by it.
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    const double touching = of(i).radius + f.ballRadius;
    const double dx = m_ball.x - body.pose.position.x, dy = m_ball.y - body.pose.position.y;
    if (dx * dx + dy * dy >= touching * touching) continue;
    const double way = approached(dx, dy);
    const Point away = way > 0.0 ? Point{dx / way, dy / way} : Point{1.0, 0.0};
    bounce(body.pose.position, body.velocity, of(i).model->mass, restitution, velocity);
    m_ball.x += away.x * (touching - way);
    m_ball.y += away.y * (touching - way);
    m_lastTouch = static_cast<int>(i);
    const double walks = body.velocity.x * away.x + body.velocity.y * away.y;
    if (walks <= 0.0) continue;
    // At 60 ticks a second each push takes a share of the robot's speed.
    const double mass = of(i).model->mass;
    const double push = constants.setup.body.ballMass / (mass + constants.setup.body.ballMass);
    const double lost = walks * std::min(1.0, push * pushesPerSecond * dt);
    body.pushed.x -= away.x * lost;
    body.pushed.y -= away.y * lost;
    body.touched = true;
  }

  double rest = 1.0;  // of the tick
  const double nearPosts = f.halfLength() - f.goalPostRadius - f.ballRadius;
  for (int bounces = 0; bounces < 3 && rest > 0.0; ++bounces) {
    const Point way{velocity.x * dt * rest, velocity.y * dt * rest};
    if (way.x == 0.0 && way.y == 0.0) break;
    double share = 1.0;
    std::ptrdiff_t robot = -1;
    for (const std::size_t i : m_here) {
      if (ballHits(m_bodies[i].pose.position, of(i).radius + f.ballRadius, way, share)) {
        robot = static_cast<std::ptrdiff_t>(i);
      }
    }
    Point postAt;
    bool atPost = false;
    if (std::abs(m_ball.x + way.x) > nearPosts || std::abs(m_ball.x) > nearPosts) {
      for (const double y : {-f.goalWidth / 2.0, f.goalWidth / 2.0}) {
        const Point at{std::copysign(f.halfLength(), m_ball.x), y};
        if (!ballHits(at, f.goalPostRadius + f.ballRadius, way, share)) continue;
        postAt = at;
        atPost = true;
      }
    }
    m_ball.x += way.x * share;
    m_ball.y += way.y * share;
    rest *= 1.0 - share;
    if (atPost) {
      bounce(postAt, {}, post, constants.setup.body.postRestitution, velocity);
    } else if (robot >= 0) {
      const auto i = static_cast<std::size_t>(robot);
      bounce(m_bodies[i].pose.position, m_bodies[i].velocity, of(i).model->mass, restitution,
             velocity);
      m_lastTouch = static_cast<int>(i);
    } else {
      break;
    }
  }
  // As in the rigid-body model: the mean speed says the speed at the end.
  const double end = mean > 0.0 ? left / mean : 0.0;
  m_ballVelocity = {velocity.x * end, velocity.y * end};
}

/// Whether the ball has left the field, and where.
void RolloutWorld::judge(const Point& before) {
  const sim::FieldSpec& f = field();
  if (!m_looked && m_tick >= m_lookTick) {
    m_look = m_ball;
    m_looked = true;
  }
  const double endX = f.halfLength() + f.ballRadius, endY = f.halfWidth() + f.ballRadius;
  const bool overEnd = std::abs(m_ball.x) > endX, overTouch = std::abs(m_ball.y) > endY;
  if (!overEnd && !overTouch) return;
  const auto shareAt = [](double from, double to, double line) {
    const double way = std::abs(to) - (to > 0.0 ? from : -from);
    return way > 0.0 ? std::clamp((line - (to > 0.0 ? from : -from)) / way, 0.0, 1.0) : 0.0;
  };
  const double atEnd = overEnd ? shareAt(before.x, m_ball.x, endX) : 2.0;
  const double atTouch = overTouch ? shareAt(before.y, m_ball.y, endY) : 2.0;
  const double y = before.y + atEnd * (m_ball.y - before.y);
  const bool goal = overEnd && atEnd <= atTouch && std::abs(y) < f.goalWidth / 2.0;
  if (goal) {
    ++(m_ball.x > 0.0 ? m_goalsLeft : m_goalsRight);
    if (std::isnan(m_timeToGoal)) m_timeToGoal = now();
  }
  if (m_goOn) {
    constexpr double inside = 1.0;  // m
    const double x = f.halfLength() - inside, side = f.halfWidth() - inside;
    restart(goal ? Point{} : Point{std::clamp(m_ball.x, -x, x), std::clamp(m_ball.y, -side, side)});
    return;
  }
  m_ended = goal ? Ended::Goal : Ended::BallOut;
  m_over = true;
}

void RolloutWorld::traceUntil(std::size_t points) {
  for (; m_traced < std::min(points, m_trace.size()); ++m_traced) {
    m_trace[m_traced] = {m_ball, m_goalsLeft, m_goalsRight};
  }
}

void RolloutWorld::restart(const Point& ball) {
  m_ball = ball;
  m_ballVelocity = {};
}

// What vision looks back at.

void RolloutWorld::remember() {
  const std::size_t at = m_tick % m_constants->moments;
  m_pastBalls[at] = m_ball;
  const std::size_t players = m_constants->players.size();
  for (const std::size_t i : m_here) {
    const Body& body = m_bodies[i];
    m_pastBodies[at * players + i] = {body.pose, body.cos, body.sin, body.head};
  }
}

const Point& RolloutWorld::ballAt(std::size_t ticksAgo) const {
  const std::size_t moments = m_constants->moments;
  return m_pastBalls[(m_tick + moments - ticksAgo) % moments];
}

const RolloutWorld::Seen& RolloutWorld::bodyAt(std::size_t ticksAgo, std::size_t i) const {
  const std::size_t moments = m_constants->moments;
  return m_pastBodies[(m_tick + moments - ticksAgo) % moments * m_constants->players.size() + i];
}

Point RolloutWorld::ballSeen(double ticksAgo) const {
  const auto whole = static_cast<std::size_t>(ticksAgo);
  const double part = ticksAgo - static_cast<double>(whole);
  const Point &late = ballAt(whole), &early = ballAt(whole + (part > 0.0 ? 1 : 0));
  return {late.x + part * (early.x - late.x), late.y + part * (early.y - late.y)};
}

RolloutWorld::Seen RolloutWorld::bodySeen(double ticksAgo, std::size_t i) const {
  const auto whole = static_cast<std::size_t>(ticksAgo);
  const double part = ticksAgo - static_cast<double>(whole);
  Seen seen = bodyAt(whole, i);
  if (part <= 0.0) return seen;
  const Seen& early = bodyAt(whole + 1, i);
  seen.pose.position.x += part * (early.pose.position.x - seen.pose.position.x);
  seen.pose.position.y += part * (early.pose.position.y - seen.pose.position.y);
  seen.pose.yaw = wrapToPi(seen.pose.yaw + part * wrapToPi(early.pose.yaw - seen.pose.yaw));
  seen.head += part * (early.head - seen.head);
  return seen;
}

/// Where the ball comes to rest if nobody touches it, at most at the lines.
Point RolloutWorld::ballRests() const {
  const double speed = approached(m_ballVelocity.x, m_ballVelocity.y);
  const double way = speed > 0.0 ? sim::rollingDistance(field().surface, speed) / speed : 0.0;
  const double x = field().halfLength(), y = field().halfWidth();
  return {std::clamp(m_ball.x + way * m_ballVelocity.x, -x, x),
          std::clamp(m_ball.y + way * m_ballVelocity.y, -y, y)};
}

void RolloutWorld::write(std::span<double> row) {
  traceUntil(m_trace.size());
  const auto put = [row](Column column, double value) {
    row[static_cast<std::size_t>(column)] = value;
  };
  const Point look = m_looked ? m_look : m_ball;
  put(Column::Seed, static_cast<double>(m_seed));
  put(Column::EndedBy, static_cast<double>(m_ended));
  put(Column::Time, now());
  put(Column::GoalsLeft, m_goalsLeft);
  put(Column::GoalsRight, m_goalsRight);
  put(Column::TimeToGoal, m_timeToGoal);
  put(Column::BallX, m_ball.x);
  put(Column::BallY, m_ball.y);
  put(Column::BallVx, m_ballVelocity.x);
  put(Column::BallVy, m_ballVelocity.y);
  put(Column::LookX, look.x);
  put(Column::LookY, look.y);
  put(Column::LastTouch, m_lastTouch);
  const Point rest = ballRests();
  for (const Side side : {Side::Left, Side::Right}) {
    double least = 1000.0;  // m: nobody plays
    for (const std::size_t i : m_here) {
      if (sideOf(i) == side) least = std::min(least, distance(m_bodies[i].pose.position, rest));
    }
    put(side == Side::Left ? Column::NearLeft : Column::NearRight, least);
  }
}

}  // namespace pitchboard::rollout
