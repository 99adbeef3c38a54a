// SPDX-License-Identifier: GPL-3.0-or-later
// How the bodies of a rollout walk, kick, fall and push each other, and how the ball rolls.
#include "rollout_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>
#include <simcore/world/action.h>
#include <simcore/world/gait_step.h>
#include <simcore/world/parameters.h>

namespace pitchboard::rollout {
namespace {

constexpr double pushesPerSecond = 60.0;
constexpr double partingSpeed = 0.5;  // m/s at which things placed onto each other part

}  // namespace

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
      const double gap = approached(dx, dy);
      const Point away = gap > 0.0 ? Point{dx / gap, dy / gap} : Point{1.0, 0.0};
      const double into = (other.velocity.x - one.velocity.x) * away.x +
                          (other.velocity.y - one.velocity.y) * away.y;
      const double depth = std::min(touching - gap, parting);
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
        const double gap = approached(dx, dy);
        const Point away = gap > 0.0 ? Point{dx / gap, dy / gap} : Point{-1.0, 0.0};
        push(i, away, std::min(touching - gap, parting),
             -(body.velocity.x * away.x + body.velocity.y * away.y), stands);
      }
    }
    const double wallX = f.halfLength() + f.border - radius;
    const double wallY = f.halfWidth() + f.border - radius;
    at = {std::clamp(at.x, -wallX, wallX), std::clamp(at.y, -wallY, wallY)};
  }
}

/// When on its way the ball's centre comes so near to a circle; a ball that lies in it is no hit.
bool RolloutWorld::ballHits(const Point& at, double radius, const Point& path,
                            double& share) const {
  const double dx = m_ball.x - at.x, dy = m_ball.y - at.y;
  const double towards = dx * path.x + dy * path.y;
  if (towards >= 0.0) return false;
  const double apart = dx * dx + dy * dy - radius * radius;
  const double length2 = path.x * path.x + path.y * path.y;
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
  const double gap = approached(dx, dy);
  const Point away = gap > 0.0 ? Point{dx / gap, dy / gap} : Point{1.0, 0.0};
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
    const double gap = approached(dx, dy);
    const Point away = gap > 0.0 ? Point{dx / gap, dy / gap} : Point{1.0, 0.0};
    bounce(body.pose.position, body.velocity, of(i).model->mass, restitution, velocity);
    m_ball.x += away.x * (touching - gap);
    m_ball.y += away.y * (touching - gap);
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
    const Point path{velocity.x * dt * rest, velocity.y * dt * rest};
    if (path.x == 0.0 && path.y == 0.0) break;
    double share = 1.0;
    std::ptrdiff_t robot = -1;
    for (const std::size_t i : m_here) {
      if (ballHits(m_bodies[i].pose.position, of(i).radius + f.ballRadius, path, share)) {
        robot = static_cast<std::ptrdiff_t>(i);
      }
    }
    Point postAt;
    bool atPost = false;
    if (std::abs(m_ball.x + path.x) > nearPosts || std::abs(m_ball.x) > nearPosts) {
      for (const double y : {-f.goalWidth / 2.0, f.goalWidth / 2.0}) {
        const Point at{std::copysign(f.halfLength(), m_ball.x), y};
        if (!ballHits(at, f.goalPostRadius + f.ballRadius, path, share)) continue;
        postAt = at;
        atPost = true;
      }
    }
    m_ball.x += path.x * share;
    m_ball.y += path.y * share;
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

/// Where the ball comes to rest if nobody touches it, at most at the lines.
Point RolloutWorld::ballRests() const {
  const double speed = approached(m_ballVelocity.x, m_ballVelocity.y);
  const double seconds = speed > 0.0 ? sim::rollingDistance(field().surface, speed) / speed : 0.0;
  const double x = field().halfLength(), y = field().halfWidth();
  return {std::clamp(m_ball.x + seconds * m_ballVelocity.x, -x, x),
          std::clamp(m_ball.y + seconds * m_ballVelocity.y, -y, y)};
}

}  // namespace pitchboard::rollout
