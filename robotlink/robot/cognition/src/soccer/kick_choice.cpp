// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/kick_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>

#include "soccer/arrival.h"

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr double kickError = 0.10;      // rad: foot, camera and pose together
constexpr double posError = 0.08;       // m across the way
constexpr double forwardWorth = 0.08;   // of a metre
constexpr double aloneWorth = 0.1;      // of a second without anybody at the ball
constexpr double clearedShare = 0.3;    // of that, when the ball must go
constexpr double opponentWorth = 0.25;  // of a ball that an opponent has first
constexpr double leavesWorth = 0.5;     // of a ball that leaves the field
constexpr double clearedOut = 0.05;     // the same when it must go
constexpr double dribbleWorth = 0.6, blockedWorth = 0.3;
constexpr double reach = 0.5;     // m to the ball: is at it
constexpr double inTime = 2.0;    // s after the ball: still a pass
constexpr double wrongWay = 1.7;  // rad from the opponents' goal

struct Candidate {
  Act act;
  double turned;  // rad from the robot's heading
};
constexpr std::array<Candidate, 6> candidates{{{acts::kickRight, 0.0},
                                               {acts::kickLeft, 0.0},
                                               {acts::weakKickRight, 0.0},
                                               {acts::weakKickLeft, 0.0},
                                               {acts::passLeft, pi / 2},
                                               {acts::passRight, -pi / 2}}};

/// The share of a normal distribution below `z`, nearly.
double below(double z) {
  return 1.0 / (1.0 + repeatable::exp(-1.702 * z));
}

Point along(const Point& from, double yaw, double heading) {
  const auto [s, c] = repeatable::sinCos(yaw);
  return {from.x + heading * c, from.y + heading * s};
}

/// An opponent that stands where the ball comes past.
bool isCovered(const WorldModel& world, const Point& from, const Point& to, double wide) {
  const double heading = distance(from, to);
  if (heading <= 0.0) return false;
  const double dx = (to.x - from.x) / heading, dy = (to.y - from.y) / heading;
  return std::ranges::any_of(world.opponents(), [&](const Point& at) {
    const double ahead = (at.x - from.x) * dx + (at.y - from.y) * dy;
    const double beside = std::abs((at.y - from.y) * dx - (at.x - from.x) * dy);
    return ahead > 0.0 && ahead < heading + wide && beside < wide;
  });
}

double rollingTime(const WorldModel& world, double speed) {
  const double slows = world.field().surface.deceleration;
  return slows > 0.0 ? speed / slows : 1.0;
}

}  // namespace

double kickRange(const WorldModel& world, const Act& kick, const sim::BallAtFeet& ball) {
  const sim::FieldSpec& field = world.field();
  return sim::rollingDistance(field.surface,
                              sim::kickSpeed(world.body(), field.robotRadius, kick.action, ball));
}

double kickRange(const WorldModel& world, const Act& kick) {
  const double side = world.body().footSide;
  const double away = world.touch() + 0.02;
  const bool left = kick == acts::kickLeft || kick == acts::weakKickLeft || kick == acts::passLeft;
  return kickRange(world, kick, {away, (left ? 1.0 : -1.0) * repeatable::atan2(side, away)});
}

GoalPart goalPart(const WorldModel& world, double aimSide) {
  const sim::FieldSpec& field = world.field();
  const double half = field.goalWidth / 2 - field.goalPostRadius - field.ballRadius;
  return {aimSide * half, half * (1.0 - std::abs(aimSide))};
}

double chanceOfGoal(const WorldModel& world, const Point& ball, double yaw, double range,
                    const GoalPart& part) {
  const sim::FieldSpec& field = world.field();
  const auto [s, c] = repeatable::sinCos(yaw);
  const double toLine = field.halfLength() - ball.x;
  if (c <= 0.1 || toLine <= 0.0) return 0.0;
  const double heading = toLine / c;
  if (heading > 0.85 * range) return 0.0;
  const double y = ball.y + heading * s;
  const double error = repeatable::hypot(kickError * heading / c, posError);
  const double chance =
      below((part.middle + part.half - y) / error) - below((part.middle - part.half - y) / error);
  const double bodies = world.field().robotRadius + field.ballRadius;
  const bool covered = isCovered(world, ball, {field.halfLength(), y}, bodies + 0.05);
  return covered ? 0.25 * chance : chance;
}

namespace {

/// Of a ball that comes to rest on the field: how far forward, and who has it next, and when.
double worthOnField(const WorldModel& world, const BehaviourParameters& numbers,
                    const KickSituation& situation, const Point& stops, double rolls) {
  double mate = 1e9, opponent = 1e9;
  for (const auto& m : world.mates()) {
    if (m && m->takesPart()) mate = std::min(mate, secondsFrom(world, m->position, stops));
  }
  for (const Point& at : world.opponents()) {
    opponent = std::min(opponent, secondsFrom(world, at, stops));
  }
  const double own = secondsTo(world, stops);
  const bool covered = isCovered(world, situation.ball, stops, numbers.passLane);
  double worth = forwardWorth * (stops.x - situation.ball.x);
  const double atFeet = reach / walkingSpeed(world);
  const double alone = std::max(0.0, std::min({mate, own, opponent}) - atFeet - rolls);
  worth -= (situation.clears ? clearedShare : 1.0) * aloneWorth * alone;
  if (mate < own && mate < opponent && mate < rolls + inTime && !covered) {
    worth += numbers.passGain;
  } else if (covered || opponent < std::min(mate, own)) {
    worth -= opponentWorth;
  }
  return worth;
}

}  // namespace

bool isTowardsOwnGoal(const WorldModel& world, const Point& ball, double yaw, const Point& stops) {
  const bool backwards = std::abs(yaw) > wrongWay;
  return backwards && (ball.x < 0.0 || stops.x < -0.25 * world.field().length);
}

std::optional<KickWorth> chooseKick(const WorldModel& world, const BehaviourParameters& numbers,
                                    const KickSituation& situation) {
  const sim::FieldSpec& field = world.field();
  const Point& ball = situation.ball;
  const sim::BallAtFeet feet{world.ballDistance(), world.ballBearing()};
  const double yaw = world.pose().yaw;
  const GoalPart part = goalPart(world, numbers.aimSide);
  std::optional<KickWorth> best;
  for (const Candidate& one : candidates) {
    const double speed = sim::kickSpeed(world.body(), field.robotRadius, one.act.action, feet);
    const double range = sim::rollingDistance(field.surface, speed);
    constexpr double squarely = 0.8;
    if (range <= squarely * kickRange(world, one.act)) continue;
    const double heading = wrapToPi(yaw + one.turned);
    const Point stops = along(ball, heading, range);
    if (isTowardsOwnGoal(world, ball, heading, stops)) continue;
    const double goal = chanceOfGoal(world, ball, heading, range, part);
    constexpr double inside = 0.1;  // m
    const bool leaves = std::abs(stops.x) > field.halfLength() - inside ||
                        std::abs(stops.y) > field.halfWidth() - inside;
    double worth = 0.0;
    if (goal > 0.0) {
      worth = goal - (1.0 - goal);
    } else if (leaves) {
      worth = situation.clears ? clearedOut : -leavesWorth;
    } else {
      worth = worthOnField(world, numbers, situation, stops, rollingTime(world, speed));
    }
    if (!best || worth > best->worth) best = KickWorth{one.act, stops, worth};
  }
  // A dribble brings it forward, too, unless somebody stands in the way.
  const bool blocked = isCovered(world, ball, along(ball, yaw, 0.8), field.robotRadius + 0.1);
  double dribble = blocked || situation.hurries ? blockedWorth : dribbleWorth;
  if (situation.clears) dribble = 0.0;
  return best && best->worth > dribble ? best : std::nullopt;
}

}  // namespace pitchboard::link
