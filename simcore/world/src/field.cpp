// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/field.h>

#include <array>
#include <cmath>

namespace pitchboard::sim {
namespace {

// Sizes of the years' rules, from the table in docs/SCENARIOS.md; the published simulator's own
// drawing comes first.
const std::array<FieldSpec, 8>& fields() {
  static const std::array<FieldSpec, 8> all = [] {
    const auto rules = [](const char* name, double length, double width, double border,
                          double goalWidth, double goalHeight, double goalAreaWidth,
                          double penaltyLength, double penaltyWidth, double mark, double circle) {
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
      return f;
    };
    return std::array<FieldSpec, 8>{
        FieldSpec{},
        rules("kid-2016", 9, 6, 0.7, 1.8, 1.1, 5, 0, 0, 2.1, 1.5),
        rules("all-2017", 9, 6, 0.7, 2.6, 1.8, 5, 0, 0, 2.1, 1.5),
        rules("kid-2020", 9, 6, 1, 2.6, 1.2, 3, 2, 5, 1.5, 1.5),
        rules("adult-2020", 14, 9, 1, 2.6, 1.8, 4, 3, 6, 2.1, 3),
        rules("small-2026", 9, 6, 1, 1.8, 1.2, 3, 2, 4, 1.5, 1.5),
        rules("middle-2026", 14, 9, 1, 2.4, 1.5, 4, 3, 6, 2, 3),
        rules("large-2026", 22, 14, 1, 3.0, 2.0, 4, 3.5, 7, 2.5, 4),
    };
  }();
  return all;
}

}  // namespace

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
  struct Length {
    const char* name;
    double value, least, most;
  };
  const Length lengths[] = {
      {"length", f.length, 1, 200},
      {"width", f.width, 1, 200},
      {"border", f.border, 0.1, 20},
      {"goal_width", f.goalWidth, 0.2, 100},
      {"goal_depth", f.goalDepth, 0.1, 20},
      {"goal_height", f.goalHeight, 0, 20},
      {"goal_post_radius", f.goalPostRadius, 0.005, 1},
      {"goal_area_length", f.goalAreaLength, 0, 100},
      {"goal_area_width", f.goalAreaWidth, 0, 200},
      {"penalty_area_length", f.penaltyAreaLength, 0, 100},
      {"penalty_area_width", f.penaltyAreaWidth, 0, 200},
      {"penalty_mark_distance", f.penaltyMarkDistance, 0, 100},
      {"centre_circle_diameter", f.centreCircleDiameter, 0, 100},
      {"line_width", f.lineWidth, 0.001, 1},
      {"ball_radius", f.ballRadius, 0.01, 0.5},
      {"robot_radius", f.robotRadius, 0.02, 1},
  };
  for (const Length& l : lengths) {
    if (!std::isfinite(l.value) || l.value < l.least || l.value > l.most) {
      return refuse(std::string(l.name) + " is " + std::to_string(l.value) + " m, allowed are " +
                    std::to_string(l.least) + " to " + std::to_string(l.most) + " m");
    }
  }
  if (f.goalWidth > f.width) return refuse("the goal is wider than the field");
  if (f.goalDepth > f.border + 1e-9) return refuse("the goal is deeper than the border");
  if (f.goalWidth < 2 * (f.goalPostRadius + f.ballRadius)) {
    return refuse("the ball does not fit between the goal posts");
  }
  return {};
}

}  // namespace pitchboard::sim
