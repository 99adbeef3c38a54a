// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_json.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;

struct Colour {
  double red = 1.0, green = 1.0, blue = 1.0, alpha = 1.0;
};
constexpr Colour white{1.0, 1.0, 1.0, 1.0};
constexpr Colour grass{0.20, 0.45, 0.25, 1.0};
constexpr Colour orange{0.95, 0.50, 0.10, 1.0};
/// Of teams, in the order of TeamColor.
constexpr std::array<Colour, 11> teamColours{{{0.16, 0.44, 0.78},
                                              {0.80, 0.22, 0.20},
                                              {0.12, 0.12, 0.12},
                                              {0.90, 0.45, 0.05},
                                              {0.90, 0.80, 0.15},
                                              {0.95, 0.95, 0.95},
                                              {0.15, 0.65, 0.30},
                                              {0.50, 0.25, 0.65},
                                              {0.45, 0.30, 0.20},
                                              {0.55, 0.55, 0.55},
                                              {0.55, 0.55, 0.55}}};
static_assert(teamColours.size() == static_cast<std::size_t>(TeamColor::Unknown) + 1);
constexpr double robotHeight = 0.5;  // m; no model has one
constexpr int circlePoints = 48;

Json colourJson(const Colour& colour) {
  return {{"r", colour.red}, {"g", colour.green}, {"b", colour.blue}, {"a", colour.alpha}};
}
Json pointJson(double x, double y, double z = 0.0) {
  return {{"x", x}, {"y", y}, {"z", z}};
}
Json poseJson(double x, double y, double z, double yaw = 0.0) {
  return {{"position", pointJson(x, y, z)},
          {"orientation",
           {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(yaw / 2.0)}, {"w", std::cos(yaw / 2.0)}}}};
}

Json line(const sim::FieldSpec& field, const std::vector<Point>& points) {
  constexpr int strip = 0;
  Json places = Json::array();
  for (const Point& point : points) places.push_back(pointJson(point.x, point.y, 0.002));
  return {{"type", strip},
          {"pose", poseJson(0.0, 0.0, 0.0)},
          {"thickness", field.lineWidth},
          {"scale_invariant", false},
          {"points", std::move(places)},
          {"color", colourJson(white)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

/// An area in front of the goal at the end `side` (-1 or 1) of the field.
std::vector<Point> areaOf(const sim::FieldSpec& field, double side, double length, double width) {
  const double end = side * field.halfLength(), inner = end - side * length;
  return {{end, width / 2}, {inner, width / 2}, {inner, -width / 2}, {end, -width / 2}};
}

Json linesOf(const sim::FieldSpec& field) {
  Json lines = Json::array();
  const double x = field.halfLength(), y = field.halfWidth();
  lines.push_back(line(field, {{-x, -y}, {x, -y}, {x, y}, {-x, y}, {-x, -y}}));
  lines.push_back(line(field, {{0.0, -y}, {0.0, y}}));
  std::vector<Point> circle;
  for (int i = 0; i <= circlePoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / circlePoints;
    const double radius = field.centreCircleDiameter / 2;
    circle.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  lines.push_back(line(field, circle));
  for (const double side : {-1.0, 1.0}) {
    lines.push_back(line(field, areaOf(field, side, field.goalAreaLength, field.goalAreaWidth)));
    if (field.penaltyAreaLength > 0.0) {
      lines.push_back(
          line(field, areaOf(field, side, field.penaltyAreaLength, field.penaltyAreaWidth)));
    }
    lines.push_back(line(field, areaOf(field, side, -field.goalDepth, field.goalWidth)));
  }
  return lines;
}

Json entity(const char* id, std::uint64_t time) {
  constexpr std::uint64_t second = 1'000'000'000;
  Json out{{"timestamp", {{"sec", time / second}, {"nsec", time % second}}},
           {"frame_id", "field"},
           {"id", id},
           {"lifetime", {{"sec", 0}, {"nsec", 0}}},
           {"frame_locked", false},
           {"metadata", Json::array()}};
  for (const char* kind :
       {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    out[kind] = Json::array();
  }
  return out;
}

Colour colourOf(const RobotFrame& robot, const Teams& teams) {
  const TeamColor colour = colourAt(robot.key.team, teams).value_or(TeamColor::Unknown);
  return teamColours[static_cast<std::size_t>(colour)];
}

Json cylinder(const Pose& pose, double radius, double height, const Colour& colour) {
  return {{"pose", poseJson(pose.position.x, pose.position.y, height / 2, pose.yaw)},
          {"size", pointJson(2 * radius, 2 * radius, height)},
          {"bottom_scale", 1.0},
          {"top_scale", 1.0},
          {"color", colourJson(colour)}};
}

Json arrow(const Pose& pose, double length, double height) {
  return {{"pose", poseJson(pose.position.x, pose.position.y, height, pose.yaw)},
          {"shaft_length", 0.6 * length},
          {"shaft_diameter", 0.04},
          {"head_length", 0.4 * length},
          {"head_diameter", 0.09},
          {"color", colourJson(white)}};
}

void addRobot(Json& robots, const RobotFrame& robot, const MatchFrame& frame) {
  const sim::FieldSpec& field = frame.settings->field;
  const double radius = robot.radius > 0.0 ? robot.radius : field.robotRadius;
  const Colour colour = colourOf(robot, frame.teams);
  const double height = robot.fallen ? radius : robotHeight;
  if (frame.truthKnown || robot.poseKnown()) {
    robots["cylinders"].push_back(cylinder(robot.pose, radius, height, colour));
    robots["arrows"].push_back(arrow(robot.pose, 2 * radius, height));
    robots["texts"].push_back(
        {{"pose", poseJson(robot.pose.position.x, robot.pose.position.y, height + 0.15)},
         {"billboard", true},
         {"font_size", 0.2},
         {"scale_invariant", false},
         {"color", colourJson(white)},
         {"text", robot.name}});
  }
  if (!frame.truthKnown || !robot.belief) return;
  Colour faint = colour;
  faint.alpha = 0.3;
  robots["cylinders"].push_back(cylinder(*robot.belief, radius, 0.02, faint));
}

}  // namespace

std::string sceneJson(const MatchFrame& frame, std::uint64_t time) {
  const sim::FieldSpec& field = frame.settings->field;
  Json ground = entity("field", time);
  ground["cubes"].push_back(
      {{"pose", poseJson(0.0, 0.0, -0.01)},
       {"size", pointJson(field.length + 2 * field.border, field.width + 2 * field.border, 0.02)},
       {"color", colourJson(grass)}});
  ground["lines"] = linesOf(field);
  Json moving = entity("robots", time);
  for (const RobotFrame& robot : frame.robots) addRobot(moving, robot, frame);
  Json ball = entity("ball", time);
  if (frame.ballKnown) {
    const Point& at = frame.snapshot.ball;
    ball["spheres"].push_back(
        {{"pose", poseJson(at.x, at.y, field.ballRadius)},
         {"size", pointJson(2 * field.ballRadius, 2 * field.ballRadius, 2 * field.ballRadius)},
         {"color", colourJson(orange)}});
  }
  return Json{{"deletions", Json::array()},
              {"entities", {std::move(ground), std::move(moving), std::move(ball)}}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

const char* const sceneSchema = R"({"title":"foxglove.SceneUpdate","type":"object","properties":{)"
                                R"("deletions":{"type":"array","items":{"type":"object"}},)"
                                R"("entities":{"type":"array","items":{"type":"object"}}}})";

}  // namespace pitchboard::link
