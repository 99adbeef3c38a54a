// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/field_svg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/report/report_page.h>

#include "report_charts.h"

namespace pitchboard::link {
namespace {

// docs/DESIGN_LANGUAGE.md; the colours of teams in the order of TeamColor.
constexpr const char *grass = "#33453a", *border = "#2c3b32", *lines = "#c3cec6",
                     *ballColour = "#f0a35e";
constexpr std::array<const char*, teamColors.size()> teamFill{"#4f8fe3", "#d8605b", "#1b1d20",
                                                              "#e8a25c", "#d8c04a"};

class Drawing {
 public:
  explicit Drawing(const sim::FieldSpec& field)
      : m_halfWidth(100 * (field.halfLength() + field.border)),
        m_halfHeight(100 * (field.halfWidth() + field.border)) {}

  void rect(double x0, double y0, double x1, double y1, const std::string& style) {
    m_body += "<rect x=\"" + n(x0) + "\" y=\"" + n(-y1) + "\" width=\"" + n(x1 - x0) +
              "\" height=\"" + n(y1 - y0) + "\" " + style + "/>";
  }
  void circle(const Point& centre, double radius, const std::string& style) {
    m_body += "<circle cx=\"" + n(100 * centre.x) + "\" cy=\"" + n(-100 * centre.y) + "\" r=\"" +
              n(radius) + "\" " + style + "/>";
  }
  void line(const Point& from, const Point& to, const std::string& style) {
    m_body += "<line x1=\"" + n(100 * from.x) + "\" y1=\"" + n(-100 * from.y) + "\" x2=\"" +
              n(100 * to.x) + "\" y2=\"" + n(-100 * to.y) + "\" " + style + "/>";
  }
  void text(const Point& at, const std::string& words) {
    m_body += "<text x=\"" + n(100 * at.x) + "\" y=\"" + n(-100 * at.y) +
              "\" dy=\"6\" text-anchor=\"middle\" font-family=\"DejaVu Sans, sans-serif\" "
              "font-size=\"17\" font-weight=\"700\" fill=\"#ffffff\">" +
              words + "</text>";
  }
  void way(std::span<const Point> points, const std::string& style) {
    m_body += "<polyline points=\"";
    for (const Point& point : points) m_body += n(100 * point.x) + ',' + n(-100 * point.y) + ' ';
    m_body += "\" fill=\"none\" stroke-linejoin=\"round\" " + style + "/>";
  }
  void closed(std::span<const Point> points, const std::string& style) {
    m_body += "<polygon points=\"";
    for (const Point& point : points) m_body += n(100 * point.x) + ',' + n(-100 * point.y) + ' ';
    m_body += "\" stroke-linejoin=\"round\" " + style + "/>";
  }
  /// With an edge of its own, so that it can be read on grass and on robots.
  void label(const Point& at, const std::string& words, const std::string& style) {
    m_body += "<text x=\"" + n(100 * at.x) + "\" y=\"" + n(-100 * at.y) +
              "\" dy=\"4\" text-anchor=\"middle\" font-family=\"DejaVu Sans, sans-serif\" "
              "font-size=\"12\" font-weight=\"700\" paint-order=\"stroke\" stroke-width=\"3\" " +
              style + ">" + escaped(words) + "</text>";
  }
  std::string document() const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + n(-m_halfWidth) + ' ' +
           n(-m_halfHeight) + ' ' + n(2 * m_halfWidth) + ' ' + n(2 * m_halfHeight) + "\">" +
           m_body + "</svg>\n";
  }

 private:
  static std::string n(double value) { return fixed(std::isfinite(value) ? value : 0.0, 1); }
  double m_halfWidth, m_halfHeight;
  std::string m_body;
};

void drawField(Drawing& d, const sim::FieldSpec& f) {
  const double x = 100 * f.halfLength(), y = 100 * f.halfWidth(), edge = 100 * f.border;
  const std::string stroke = std::string("fill=\"none\" stroke=\"") + lines + "\" stroke-width=\"" +
                             fixed(100 * f.lineWidth, 1) + '"';
  d.rect(-x - edge, -y - edge, x + edge, y + edge, std::string("fill=\"") + border + '"');
  d.rect(-x, -y, x, y, std::string("fill=\"") + grass + '"');
  d.rect(-x, -y, x, y, stroke);
  d.line({0, -f.halfWidth()}, {0, f.halfWidth()}, stroke);
  d.circle({}, 50 * f.centreCircleDiameter, stroke);
  for (const double side : {-1.0, 1.0}) {
    const auto area = [&](double length, double width) {
      if (length <= 0 || width <= 0) return;
      const double inner = side * (x - 100 * length), outer = side * x;
      d.rect(std::min(inner, outer), -50 * width, std::max(inner, outer), 50 * width, stroke);
    };
    area(f.goalAreaLength, f.goalAreaWidth);
    area(f.penaltyAreaLength, f.penaltyAreaWidth);
    const double back = side * (x + 100 * f.goalDepth), front = side * x;
    d.rect(std::min(back, front), -50 * f.goalWidth, std::max(back, front), 50 * f.goalWidth,
           stroke);
    d.circle({side * (f.halfLength() - f.penaltyMarkDistance), 0}, 5,
             std::string("fill=\"") + lines + '"');
  }
}

struct Ink {
  std::string colour = {};  // of SVG
  double opacity = 1.0;
  bool isDark = false;
  std::string as(const char* paint, double share = 1.0) const {
    return std::string(paint) + "=\"" + colour + "\" " + paint + "-opacity=\"" +
           fixed(opacity * share, 2) + "\" ";
  }
};

Ink inkOf(const telemetry::DrawingShape& shape, const char* team) {
  if (!shape.colour)
    return {team, 1.0, team == teamFill[static_cast<std::size_t>(TeamColor::Black)]};
  const std::uint32_t c = *shape.colour, red = c >> 16 & 255U, green = c >> 8 & 255U,
                      blue = c & 255U;
  std::array<char, 16> hex{};
  std::snprintf(hex.data(), hex.size(), "#%06x", c & 0xffffffU);
  return {hex.data(), static_cast<double>(c >> 24) / 255.0,
          11 * red + 16 * green + 5 * blue < 32 * 90};
}

/// One pixel of the screen is drawn as one centimetre: a field fills a window at about that scale.
void drawShape(Drawing& d, const telemetry::DrawingShape& shape, const Pose& origin,
               const Ink& ink) {
  using telemetry::ShapeKind;
  constexpr double headLength_cm = 11.0, headWidth_cm = 4.5, pointRadius_cm = 3.0, fillShare = 0.35;
  std::vector<Point> points;
  points.reserve(shape.points.size());
  const double c = std::cos(origin.yaw), s = std::sin(origin.yaw);
  for (const Point& p : shape.points) {
    points.push_back(
        {origin.position.x + c * p.x - s * p.y, origin.position.y + s * p.x + c * p.y});
  }
  if (points.empty()) return;
  const std::string stroke =
      ink.as("stroke") + "stroke-linecap=\"round\" stroke-width=\"" + fixed(shape.width, 1) + "\" ";
  const std::string filled = ink.as("fill", fillShare) + stroke;
  const std::string empty = "fill=\"none\" " + stroke;
  switch (shape.kind) {
    case ShapeKind::Line:
      return d.way(points, stroke);
    case ShapeKind::Arrow: {
      const Point tip = points.back(), before = points[points.size() - 2];
      const double length = distance(before, tip);
      if (length < 0.01) return d.way(points, stroke);
      const double aheadX = (tip.x - before.x) / length, aheadY = (tip.y - before.y) / length;
      const auto behind = [&](double back, double aside) {
        return Point{tip.x - aheadX * back - aheadY * aside,
                     tip.y - aheadY * back + aheadX * aside};
      };
      const double head = std::min((headLength_cm + shape.width) / 100, length);
      const double wide = (headWidth_cm + shape.width / 2) * head / (headLength_cm + shape.width);
      points.back() = behind(0.8 * head, 0.0);
      d.way(points, stroke);
      const std::array triangle{tip, behind(head, wide), behind(head, -wide)};
      return d.closed(triangle, ink.as("fill"));
    }
    case ShapeKind::Circle:
      return d.circle(points.front(), 100 * shape.radius, empty);
    case ShapeKind::Disc:
      return d.circle(points.front(), 100 * shape.radius, filled);
    case ShapeKind::Polygon:
      return d.closed(points, empty);
    case ShapeKind::Area:
      return d.closed(points, filled);
    case ShapeKind::Point:
      return d.circle(points.front(), std::max(pointRadius_cm, shape.width), ink.as("fill"));
    case ShapeKind::Text:
      return d.label(points.front(), shape.text,
                     ink.as("fill") + (ink.isDark ? "stroke=\"#ffffff\"" : "stroke=\"#141a16\""));
  }
}

const char* fillOf(const RobotFrame& robot) {
  return teamFill[static_cast<std::size_t>(robot.identity.team) % teamFill.size()];
}

/// What the robots' programs drew, as the studio shows it with all of its layers.
void drawDrawings(Drawing& d, const MatchFrame& frame) {
  for (const telemetry::RobotDrawings& drawn : frame.drawings) {
    const RobotFrame* robot = frame.robot(RobotId{drawn.robot});
    const char* team = robot ? fillOf(*robot) : teamFill.front();
    for (const auto& layer : drawn.layers) {
      const auto origin = drawingOrigin(layer->frame, robot);
      if (!origin) continue;
      for (const telemetry::DrawingShape& shape : layer->shapes) {
        drawShape(d, shape, *origin, inkOf(shape, team));
      }
    }
  }
}

}  // namespace

std::string fieldSvg(const MatchFrame& frame) {
  Drawing d(frame.settings->field);
  drawField(d, frame.settings->field);
  for (const RobotFrame& robot : frame.robots) {
    if (!robot.poseKnown()) continue;
    const char* fill = fillOf(robot);
    const double radius_m = robot.radius > 0.0 ? robot.radius : frame.settings->field.robotRadius;
    const double radius = 100 * radius_m;
    const std::string stroke = std::string("stroke=\"") + fill + "\" stroke-width=\"3\"";
    if (frame.truthKnown && robot.belief) {
      d.line(robot.pose.position, robot.belief->position, stroke + " stroke-opacity=\"0.6\"");
      d.circle(robot.belief->position, radius, "fill=\"none\" stroke-dasharray=\"6 4\" " + stroke);
    }
    const Point& at = robot.pose.position;
    const double reach = 1.9 * radius_m;
    d.line(at, {at.x + reach * std::cos(robot.pose.yaw), at.y + reach * std::sin(robot.pose.yaw)},
           stroke + " stroke-linecap=\"round\"");
    d.circle(at, radius,
             std::string("fill=\"") + fill + "\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
    d.text(at, std::to_string(robot.identity.number));
  }
  if (frame.ballKnown) {
    d.circle(frame.snapshot.ball, 100 * frame.settings->field.ballRadius,
             std::string("fill=\"") + ballColour + "\" stroke=\"#1b1d20\" stroke-width=\"1.5\"");
  }
  drawDrawings(d, frame);
  return d.document();
}

std::string fieldSvg(const sim::FieldSpec& field, std::span<const FieldWay> ways) {
  Drawing d(field);
  drawField(d, field);
  for (const FieldWay& way : ways) {
    const std::string opacity = fixed(way.opacity, 2);
    d.way(way.points, "stroke=\"" + way.colour + "\" stroke-opacity=\"" + opacity +
                          "\" stroke-width=\"" + fixed(way.width, 1) + '"');
    if (way.marksEnd && !way.points.empty()) {
      d.circle(way.points.back(), 5, "fill=\"" + way.colour + "\" fill-opacity=\"" + opacity + '"');
    }
  }
  return d.document();
}

}  // namespace pitchboard::link
