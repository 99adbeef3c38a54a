// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/robot_model.h>

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <base/repeatable_math.h>
#include <simcore/world/action.h>
#include <simcore/world/parameters.h>
#include <simcore/world/published_frame.h>

#include "parameter_check.h"

namespace pitchboard::sim {
namespace {

constexpr int kickRight = 4;
constexpr int weakKickRight = 21;
constexpr int weakKickLeft = 22;

/// The published law.
double publishedKick(double radius, const KickRule& rule, const BallAtFeet& ball) {
  constexpr double strongest = 10.0;  // cm per frame
  // A kick that would give the ball less does not reach it: the law has no end, and a kick at the
  // far side of the field would stop a rolling ball.
  constexpr double least = 0.05;  // cm per frame
  const double bearing = degreesFromRadians(ball.bearing);
  if (bearing <= -rule.rightLimit || bearing >= rule.leftLimit) return 0.0;
  const double reach_cm = published_frame::cmFromMetres(radius);
  const double gap = (reach_cm - published_frame::cmFromMetres(ball.distance)) / rule.strength;
  const double force =
      std::min(strongest, rule.strength * repeatable::exp(-gap * gap)) * rule.share;
  return force < least ? 0.0 : published_frame::mpsFromCmPerFrame(force);
}

/// The foot's law: full speed in front of the foot, less beside it.
double footKick(const RobotModel& model, const Action& action, const BallAtFeet& ball) {
  if (ball.distance > model.kickReach) return 0.0;
  const double y = ball.distance * repeatable::sin(ball.bearing);
  const bool pass = action.kick.direction != 0.0;
  const bool weak = action.code == weakKickRight || action.code == weakKickLeft;
  const bool right = action.code == kickRight || action.code == weakKickRight;
  // The foot's own side is positive; a pass takes the foot that is nearer.
  const double side = pass ? (y < 0.0 ? -1.0 : 1.0) : (right ? -1.0 : 1.0);
  const double bearing = side * ball.bearing;
  if (bearing > model.kickOuter || bearing < -(pass ? model.kickOuter : model.kickInner)) {
    return 0.0;
  }
  const double beside = (side * y - model.footSide) / model.footWidth;
  const double most = pass ? model.passSpeed : weak ? model.weakKickSpeed : model.kickSpeed;
  return most * repeatable::exp(-0.5 * beside * beside);
}

}  // namespace

double kickSpeed(const RobotModel& model, double radius, int action, const BallAtFeet& ball) {
  const Action* kick = findAction(action);
  if (kick == nullptr || kick->kind != ActionKind::Kick) return 0.0;
  return model.kickLaw == KickLaw::Foot ? footKick(model, *kick, ball)
                                        : publishedKick(radius, kick->kick, ball);
}

int simulatedVoltage(const RobotModel& model) {
  constexpr double charge = 17.0 / 18.0;
  const double volts = model.batteryEmpty + charge * (model.batteryFull - model.batteryEmpty);
  return static_cast<int>(std::lround(10.0 * volts));
}

GaitSpeed gaitSpeed(const RobotModel& model, int action, int b) {
  constexpr int minFixedB = 10;  // from here on action 8 walks at its full speed
  switch (action) {
    case 1:
      return {model.forwardFast, 0.0, 0.0, true};
    case 2:
      return {0.0, 0.0, model.turn, true};
    case 3:
      return {0.0, 0.0, -model.turn, true};
    case 6:
      return {0.0, model.sideways, 0.0, true};
    case 7:
      return {0.0, -model.sideways, 0.0, true};
    case 8:
      return {b < minFixedB ? model.forwardSlow / minFixedB * b : model.forwardSlow, 0.0, 0.0,
              true};
    case 9:
      return {0.0, model.aroundSideways, -model.aroundTurn, true};
    case 14:
      return {0.0, -model.aroundSideways, model.aroundTurn, true};
    case 17:
      return {-model.backwardFast, 0.0, 0.0, true};
    case 18:
      return {-model.backwardSlow, 0.0, 0.0, true};
    default:
      break;
  }
  const Action* entry = findAction(action);
  return {0.0, 0.0, 0.0, entry != nullptr && entry->kind == ActionKind::InPlace};
}

Result<void> validate(const RobotModel& model) {
  const auto refuse = [](const BadParameter& bad, const std::string& path) {
    return failure(ErrorCode::InvalidArgument, "This value " + bad.text + ".", path + bad.key);
  };
  if (const auto bad = firstBad<RobotModel>(model, robotModelParameters); !bad.key.empty()) {
    return refuse(bad, "robot_model.");
  }
  if (const auto bad = firstBad<NoiseParameters>(model.noise, noiseParameters); !bad.key.empty()) {
    return refuse(bad, "robot_model.noise.");
  }
  if (model.noise.ofModel) {
    return refuse({"noise", "must be numbers or a preset, and is \"robot\" itself"},
                  "robot_model.");
  }
  return {};
}

}  // namespace pitchboard::sim
