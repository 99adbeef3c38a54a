// SPDX-License-Identifier: GPL-3.0-or-later
// The beginning, the cycles and the outcome of a rollout.
#include "rollout_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>
#include <base/try.h>
#include <simcore/world/gait_step.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::rollout {
namespace {

using link::SoccerPlayer;
using std::numbers::pi;

constexpr int reminders = 9;  // cycles until a player has looked for opponents
constexpr int talkCycles = 2;

link::SoccerPlayerOptions soccerPlayerOptions(const Setup& setup, const Player& player) {
  link::SoccerPlayerOptions options;
  options.field = setup.field;
  options.model = player.model;
  options.behaviour = player.behaviour;
  options.facesLeft = player.side == Side::Right;
  return options;
}

}  // namespace

Result<std::shared_ptr<const RolloutConstants>> RolloutConstants::create(const Setup& setup) {
  TRY(sim::validate(setup.field));
  const auto refuse = [](const std::string& text, const char* key) {
    return failure(ErrorCode::InvalidArgument, text, key);
  };
  if (setup.players.empty() || setup.players.size() > Rollouts::maxPlayers) {
    return refuse("A rollout has 1 to " + std::to_string(Rollouts::maxPlayers) + " players.",
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
  made->randomsPerCycle = std::max(6, 3 * made->ticksPerCycle);
  const int players = static_cast<int>(setup.players.size());
  double maxDelay = 0.0;
  for (const Player& player : made->setup.players) {
    made->fresh.push_back(TRY(SoccerPlayer::create(soccerPlayerOptions(setup, player))));
    Of of;
    of.model = &player.model;
    of.noise = setup.noise.ofModel ? player.model.noise : setup.noise;
    of.belief = beliefNoise(of.noise);
    of.radius = player.model.radius > 0.0 ? player.model.radius : setup.field.robotRadius;
    of.delayTicks = of.noise.visionDelay / made->dt;
    maxDelay = std::max(maxDelay, of.delayTicks);
    made->players.push_back(of);
  }
  made->moments = static_cast<std::size_t>(maxDelay) + 2;
  for (int i = 1; i <= players; ++i) made->drawers.push_back(i);
  for (int i = 1; i <= players; ++i) made->drawers.push_back(1000 + i);
  return std::shared_ptr<const RolloutConstants>(std::move(made));
}

Result<RolloutWorld> RolloutWorld::create(std::shared_ptr<const RolloutConstants> constants) {
  RolloutWorld world;
  const Setup& setup = constants->setup;
  for (const Player& player : setup.players) {
    world.m_soccerPlayers.push_back(TRY(SoccerPlayer::create(soccerPlayerOptions(setup, player))));
  }
  world.m_pastBalls.resize(constants->moments);
  world.m_pastBodies.resize(constants->moments * setup.players.size());
  world.m_motionNoise.reserve(setup.players.size());
  world.m_constants = std::move(constants);
  return world;
}

void RolloutWorld::begin(const Belief& belief, std::uint64_t seed, const PlayOptions& options,
                         std::span<TracePoint> trace) {
  m_seed = seed;
  m_tick = m_cycle = 0;
  m_goOn = options.goOn;
  m_game = belief.game;
  const double seconds = std::min(options.seconds, std::max(0.0, belief.game.secondsLeft));
  m_lastTick = static_cast<std::uint64_t>(std::llround(seconds / m_constants->dt));
  m_lookTick = static_cast<std::uint64_t>(std::llround(options.look / m_constants->dt));
  m_ended = Ended::Time;
  m_over = m_looked = false;
  m_goalsLeft = m_goalsRight = 0;
  m_lastTouch = -1;
  m_timeToGoal = std::numeric_limits<double>::quiet_NaN();
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
  replayPast(belief);
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
    body.sigma = std::max(known.sigma, of(i).belief.place.filterSigma);
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

/// Every player has seen, in the second before, what was in front of it: the ball where it is
/// believed to have rolled, then opponents.
void RolloutWorld::replayPast(const Belief& belief) {
  const BallBelief& ball = belief.ball;
  std::array<std::size_t, 2> first{most, most};  // at the ball
  std::array<double, 2> least{1e9, 1e9};
  for (const std::size_t i : m_here) {
    const auto side = static_cast<std::size_t>(sideOf(i));
    const double metres = distance(belief.robots[i].pose.position, ball.place);
    if (metres >= least[side] || m_constants->setup.players[i].behaviour.name == "keeper") continue;
    least[side] = metres;
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
    m_sent[i] = {pose.position,
                 isKeeper                                          ? link::Intention::Keep
                 : first[static_cast<std::size_t>(sideOf(i))] == i ? link::Intention::Ball
                                                                   : link::Intention::Support,
                 !body.isDown(),
                 {}};

    link::SoccerPlayer& soccerPlayer = m_soccerPlayers[i];
    soccerPlayer.copyState(m_constants->fresh[i]);
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
      if (m_input.ball && k == reminders - 1) m_sent[i].ball = was;
      soccerPlayer.observe(m_input, -ball.age - ago);
    }
  }
}

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
               constants.randomsPerCycle);
  m_motionNoise.clear();
  const std::size_t players = constants.players.size();
  for (std::size_t i = 0; i < players; ++i) m_motionNoise.push_back(m_noise.of(i));
  if (m_cycle % talkCycles == 0) talk();
  if (m_game.setPlay != SetPlay::None) {
    constexpr double taken = 0.1;  // m
    m_game.setPlayLeft -= cycleTime;
    if (m_game.setPlayLeft < 0.0 || distance(m_ball, m_setPlayBall) > taken) {
      m_game.setPlay = SetPlay::None;
    }
  }
  for (const std::size_t i : m_here) {
    Body& body = m_bodies[i];
    RandomBatch::Sequence random = m_noise.of(players + i);
    drift(i, random);
    m_input.referee = refereeFor(i);
    m_input.fallen = body.isDown();
    m_input.setPlay = m_game.setPlay;
    m_input.setPlayIsOurs = m_game.setPlaySide == sideOf(i);
    m_input.believed = believed(i);
    m_input.sigma = body.sigma;
    m_input.imuYaw = wrapToPi(m_input.believed.yaw - (sideOf(i) == Side::Right ? pi : 0.0));
    m_input.doing = {body.isDown() ? body.action.action : body.command.action, body.command.b};
    look(i, random);
    listen(i);
    const link::PlayerDecision decision = m_soccerPlayers[i].step(m_input, now());
    body.command = decision.act;
    body.search = body.search || decision.search;
    body.looksForOpponents = decision.looksForOpponents;
    m_sent[i] = {m_input.believed.position, decision.intention, !body.isDown(), decision.ball};
  }
}

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

void RolloutWorld::traceUntil(std::size_t points) {
  for (; m_traced < std::min(points, m_trace.size()); ++m_traced) {
    m_trace[m_traced] = {m_ball, m_goalsLeft, m_goalsRight};
  }
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
    double least = 1000.0;  // m; no robot plays
    for (const std::size_t i : m_here) {
      if (sideOf(i) == side) least = std::min(least, distance(m_bodies[i].pose.position, rest));
    }
    put(side == Side::Left ? Column::NearLeft : Column::NearRight, least);
  }
}

}  // namespace pitchboard::rollout
