// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/build_robot.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include <base/angles.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;
using telemetry::HeartbeatState;

/// Sane numbers for drawing; what was sent stays in `values`.
constexpr double farAway_cm = 10'000.0;
constexpr double perVolt = 10.0;

std::optional<Pose> beliefOf(const RobotReader& reader, const sim::FieldSpec& field) {
  const auto x = reader(FieldMeaning::X), y = reader(FieldMeaning::Y);
  if (!x || !y) return std::nullopt;
  const auto sane = [](double cm) { return std::clamp(cm, -farAway_cm, farAway_cm); };
  const double degrees = std::fmod(reader(FieldMeaning::Theta).value_or(0.0), 360.0);
  return sim::published_frame::studioFromLocalization(field, {sane(*x), sane(*y), degrees});
}

/// system.md section 7: in distance BALL_DIST, at angle THETA + BALL_ANGLE; -1 is no ball.
std::optional<SeenBall> ballSeenFrom(const Pose& origin, const RobotReader& reader,
                                     const sim::FieldSpec& field) {
  const auto distance = reader(FieldMeaning::BallDistance), angle = reader(FieldMeaning::BallAngle);
  if (!distance || !angle || !std::isfinite(*angle)) return std::nullopt;
  SeenBall ball;
  ball.distance = sim::published_frame::metresFromCm(*distance);
  // A percept farther away than twice the field cannot be the ball.
  if (!(ball.distance > 0.0) || !(ball.distance < 2 * field.length)) return std::nullopt;
  ball.bearing = radiansFromDegrees(std::fmod(*angle, 360.0));
  const double direction = origin.yaw + ball.bearing;
  ball.place = {origin.position.x + ball.distance * std::cos(direction),
                origin.position.y + ball.distance * std::sin(direction)};
  return ball;
}

TeamBall meanOf(const std::vector<Point>& balls, const Point& centre) {
  TeamBall agreed;
  std::vector<Point> near;
  std::ranges::copy_if(balls, std::back_inserter(near), [&centre](const Point& ball) {
    return distance(centre, ball) <= TeamBall::reach;
  });
  agreed.see = static_cast<int>(balls.size());
  agreed.agree = static_cast<int>(near.size());
  for (const Point& ball : near) {
    agreed.position.x += ball.x / agreed.agree;
    agreed.position.y += ball.y / agreed.agree;
  }
  double squares = 0.0;
  for (const Point& ball : near) {
    const double dx = ball.x - agreed.position.x, dy = ball.y - agreed.position.y;
    squares += dx * dx + dy * dy;
  }
  agreed.spread = std::sqrt(squares / agreed.agree);
  return agreed;
}

}  // namespace

const LampMemory::Lamps& LampMemory::note(const RobotReader& reader, double time) {
  for (std::size_t i = 0; i < m_lamps.size(); ++i) {
    const auto set =
        reader(static_cast<FieldMeaning>(static_cast<std::size_t>(FieldMeaning::Control) + i));
    if (set && *set != 0.0) m_seen[i] = time;
    HeartbeatState now = m_lamps[i].state;
    if (time - m_seen[i] <= flagMemory) {
      now = HeartbeatState::Working;
    } else if (now == HeartbeatState::Working) {
      now = HeartbeatState::NotResponding;
    }
    if (now != m_lamps[i].state) m_since[i] = time;
    const std::chrono::duration<double> since(std::max(0.0, time - m_since[i]));
    m_lamps[i] = {now, now == HeartbeatState::Working ? 1.0 : 0.0,
                  std::chrono::duration_cast<telemetry::Duration>(since)};
  }
  return m_lamps;
}

void LampMemory::saw(std::size_t lamp, double time) {
  m_seen[lamp] = std::max(m_seen[lamp], time);
}

void buildRobot(const RobotReader& reader, const sim::FieldSpec& field,
                const telemetry::BatteryLimits& battery, bool truthKnown, RobotFrame& robot) {
  constexpr std::size_t vision = 1, localization = 2;
  const auto works = [&robot](std::size_t lamp) {
    return robot.lamps[lamp].state == HeartbeatState::Working;
  };
  // All that is known of the place is not hidden because the flag is not set.
  robot.belief = truthKnown && !works(localization) ? std::nullopt : beliefOf(reader, field);
  // Before anybody writes it, a blackboard is full of zeros: a corner of the field.
  const auto isZero = [&reader](FieldMeaning meaning) {
    return reader(meaning).value_or(0.0) == 0.0;
  };
  if (!works(localization) && isZero(FieldMeaning::X) && isZero(FieldMeaning::Y) &&
      isZero(FieldMeaning::Theta)) {
    robot.belief.reset();
  }
  if (!truthKnown) {
    robot.pose = robot.belief.value_or(Pose{});
    robot.headYaw = robot.pose.yaw;
  }
  const auto sigma = reader(FieldMeaning::Belief);
  robot.sigma = sigma ? std::optional(sim::published_frame::metresFromCm(*sigma)) : std::nullopt;
  // A message says itself whether its ball counts; a blackboard keeps the last one.
  const auto seen = reader(FieldMeaning::BallSeen);
  const bool stale = robot.timedOut() || (seen && (*seen <= 0.0 || !works(vision)));
  robot.ball.reset();
  if (!stale && (truthKnown || robot.belief)) {
    robot.ball = ballSeenFrom(robot.belief.value_or(robot.pose), reader, field);
  }
  constexpr double most = 2147483647.0;
  const auto action = reader(FieldMeaning::Action);
  robot.decided.reset();
  if (action) robot.decided = static_cast<int>(std::clamp(*action, -most, most));
  const double volts = reader(FieldMeaning::Voltage).value_or(0.0) / perVolt;
  robot.battery.reset();
  if (volts > 0.0) robot.battery = telemetry::batteryAt(volts, battery);
}

std::vector<TeamBall> agreedBalls(std::span<const RobotFrame> robots) {
  std::vector<TeamBall> agreed;
  for (const TeamColorInfo& team : teamColors) {
    std::vector<Point> balls;
    for (const RobotFrame& robot : robots) {
      if (robot.identity.team != team.color || !robot.ball) continue;
      const Point& place = robot.ball->place;
      if (std::isfinite(place.x) && std::isfinite(place.y)) balls.push_back(place);
    }
    const auto near = [&balls](const Point& centre) {
      return std::ranges::count_if(balls, [&centre](const Point& ball) {
        return distance(centre, ball) <= TeamBall::reach;
      });
    };
    const auto centre = std::ranges::max_element(balls, {}, near);
    if (centre == balls.end() || near(*centre) < 2) continue;
    agreed.push_back(meanOf(balls, *centre));
    agreed.back().team = team.color;
  }
  return agreed;
}

}  // namespace pitchboard::link
