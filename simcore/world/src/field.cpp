// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/field.h>

#include <array>

#include <base/repeatable_math.h>
#include <simcore/world/published_frame.h>

#include "parameter_check.h"

namespace pitchboard::sim {
namespace {

// The balls of the leagues: FIFA sizes 1 (kid size since 2016, small), 3 (middle) and 5 (adult,
// large).
struct Ball {
  double radius;  // m
  double mass;    // kg
};
constexpr Ball fifa1{0.07, 0.205}, fifa3{0.095, 0.31}, fifa5{0.11, 0.43};

// A ball loses 0.30 m/s² on artificial grass: bhuman/BHumanCodeRelease, Config. Nothing was found
// for other lengths of the grass or larger balls.
constexpr Surface grass{.deceleration = 0.30, .keptPerFrame = 1.0};

// Sizes of the years' rules, from the table in docs/scenarios.md; the published simulator's own
// drawing comes first. Robots have a radius of about 0.22 of the height of their class (0.5 to 0.6
// m, 0.9 to 1.0 m, 1.3 m); the rules allow 0.275.
const std::array<FieldSpec, 8>& fields() {
  static const std::array<FieldSpec, 8> all = [] {
    const auto rules = [](const char* name, double length, double width, double border,
                          double goalWidth, double goalHeight, double goalAreaWidth,
                          double penaltyLength, double penaltyWidth, double mark, double circle,
                          const Ball& ball, double robotRadius) {
      FieldSpec f;
      f.name = name;
      f.length = length;
      f.width = width;
      f.border = border;
      f.goalWidth = goalWidth;
      f.goalDepth = 0.6;
      f.goalHeight = goalHeight;
      f.goalAreaLength = 1.0;
      f.goalAreaWidth = goalAreaWidth;
      f.penaltyAreaLength = penaltyLength;
      f.penaltyAreaWidth = penaltyWidth;
      f.penaltyMarkDistance = mark;
      f.centreCircleDiameter = circle;
      f.ballRadius = ball.radius;
      f.ballMass = ball.mass;
      f.robotRadius = robotRadius;
      f.surface = grass;
      return f;
    };
    // Lines, marks and arcs: the drawings of the league of 2026 (HSL-Rules, figs/FieldGenerator).
    const auto soccer = [](FieldSpec f, double lineWidth, double mark, double arc) {
      f.lineWidth = lineWidth;
      f.markDiameter = mark;
      f.cornerArcRadius = arc;
      return f;
    };
    return std::array<FieldSpec, 8>{
        FieldSpec{},
        rules("kid-2016", 9, 6, 0.7, 1.8, 1.1, 5, 0, 0, 2.1, 1.5, fifa1, 0.13),
        rules("all-2017", 9, 6, 0.7, 2.6, 1.8, 5, 0, 0, 2.1, 1.5, fifa1, 0.13),
        rules("kid-2020", 9, 6, 1, 2.6, 1.2, 3, 2, 5, 1.5, 1.5, fifa1, 0.13),
        rules("adult-2020", 14, 9, 1, 2.6, 1.8, 4, 3, 6, 2.1, 3, fifa5, 0.28),
        soccer(rules("small-2026", 9, 6, 1, 1.8, 1.2, 3, 2, 4, 1.5, 1.5, fifa1, 0.13), 0.05, 0.1,
               0),
        soccer(rules("middle-2026", 14, 9, 1, 2.4, 1.5, 4, 3, 6, 2, 3, fifa3, 0.22), 0.05, 0.1,
               0.5),
        soccer(rules("large-2026", 22, 14, 1, 3.0, 2.0, 5, 3.5, 7, 2.5, 4, fifa5, 0.28), 0.12, 0.15,
               1),
    };
  }();
  return all;
}

}  // namespace

double rollingDistance(const Surface& surface, double speed) {
  // dv/dt = -a - r v. The rate r is such that the share alone gives the published sum
  // v·f/60 + v·f²/60 + ...
  const double a = surface.deceleration, f = surface.keptPerFrame;
  if (speed <= 0.0 || f <= 0.0) return 0.0;
  const double r = (1.0 - f) * published_frame::framesPerSecond / f;
  if (r <= 0.0) return 0.5 * speed * speed / a;
  if (a <= 0.0) return speed / r;
  return (speed - a / r * repeatable::log(1.0 + r * speed / a)) / r;
}

std::span<const FieldSpec> builtInFields() {
  return fields();
}

Result<FieldSpec> fieldByName(std::string_view name) {
  std::string known;
  for (const FieldSpec& field : fields()) {
    if (field.name == name) return field;
    known += (known.empty() ? "" : ", ") + field.name;
  }
  return failure(ErrorCode::NotFound, "There is no field called \"" + std::string(name) +
                                          "\". Known fields: " + known + ".");
}

Result<void> validate(const FieldSpec& f) {
  const auto refuse = [&](const std::string& why) {
    return failure(ErrorCode::InvalidArgument, "This field cannot be played on: " + why + ".",
                   "field \"" + f.name + "\"");
  };
  if (const auto bad = firstBad<FieldSpec>(f, fieldParameters); !bad.key.empty()) {
    return refuse(bad.key + ' ' + bad.text);
  }
  if (const auto bad = firstBad<Surface>(f.surface, surfaceParameters); !bad.key.empty()) {
    return refuse(bad.key + ' ' + bad.text);
  }
  if (f.goalWidth > f.width) return refuse("the goal is wider than the field");
  if (f.goalDepth > f.border + 1e-9) return refuse("the goal is deeper than the border");
  if (f.goalWidth < 2 * (f.goalPostRadius + f.ballRadius)) {
    return refuse("the ball does not fit between the goal posts");
  }
  return {};
}

}  // namespace pitchboard::sim
