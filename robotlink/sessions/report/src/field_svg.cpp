// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/field_svg.h>

#include <cmath>

#include <robotlink/report/report_page.h>
#include <simcore/world/field_lines.h>

namespace pitchboard::link {
namespace {

// docs/design-language.md
constexpr const char *grass = "#33453a", *border = "#2c3b32", *lines = "#c3cec6";

/// Metres as centimetres of the drawing.
std::string cm(double metres) {
  return fixed(std::isfinite(metres) ? 100 * metres : 0.0, 1);
}

std::string rect(const sim::FieldLines::Box& box, const std::string& style) {
  return "<rect x=\"" + cm(box.low.x) + "\" y=\"" + cm(-box.high.y) + "\" width=\"" +
         cm(box.high.x - box.low.x) + "\" height=\"" + cm(box.high.y - box.low.y) + "\" " + style +
         "/>";
}

std::string circle(const Point& centre, double radius, const std::string& style) {
  return "<circle cx=\"" + cm(centre.x) + "\" cy=\"" + cm(-centre.y) + "\" r=\"" + cm(radius) +
         "\" " + style + "/>";
}

}  // namespace

std::string fieldSvg(const sim::FieldSpec& field, std::span<const FieldTrajectory> trajectories,
                     const std::string& below) {
  const Point corner{field.halfLength(), field.halfWidth()};
  const Point wall{corner.x + field.border, corner.y + field.border};
  const auto filled = [](const char* colour) { return std::string("fill=\"") + colour + '"'; };
  const std::string outline = std::string("fill=\"none\" stroke=\"") + lines +
                              "\" stroke-width=\"" + cm(field.lineWidth) + '"';
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + cm(-wall.x) + ' ' +
                    cm(-wall.y) + ' ' + cm(2 * wall.x) + ' ' + cm(2 * wall.y) + "\">";
  svg += rect({{-wall.x, -wall.y}, wall}, filled(border));
  svg += rect({{-corner.x, -corner.y}, corner}, filled(grass)) + below;
  const sim::FieldLines shapes = sim::fieldLines(field, field.lineWidth);
  for (const auto& line : shapes.lines) svg += rect(line, filled(lines));
  for (const auto& goal : shapes.goals) svg += rect(goal, outline);
  if (shapes.circleRadius > 0) svg += circle({}, shapes.circleRadius, outline);
  if (shapes.arcRadius > 0) {
    const std::string r = cm(shapes.arcRadius);
    for (const double x : {-corner.x, corner.x}) {
      for (const double y : {-corner.y, corner.y}) {
        const double inX = x - std::copysign(shapes.arcRadius, x);
        const double inY = y - std::copysign(shapes.arcRadius, y);
        svg += "<path d=\"M" + cm(inX) + ' ' + cm(-y) + " A" + r + ' ' + r + " 0 0 " +
               (x * y > 0 ? '0' : '1') + ' ' + cm(x) + ' ' + cm(-inY) + "\" " + outline + "/>";
      }
    }
  }
  const double markRadius = shapes.markRadius > 0 ? shapes.markRadius : field.lineWidth;
  for (const Point& mark : shapes.marks) svg += circle(mark, markRadius, filled(lines));
  for (const FieldTrajectory& one : trajectories) {
    const std::string opacity = fixed(one.opacity, 2);
    svg += "<polyline points=\"";
    for (const Point& point : one.points) svg += cm(point.x) + ',' + cm(-point.y) + ' ';
    svg += "\" fill=\"none\" stroke-linejoin=\"round\" stroke=\"" + one.colour +
           "\" stroke-opacity=\"" + opacity + "\" stroke-width=\"" + cm(one.width) + "\"/>";
    if (one.points.empty()) continue;
    if (!one.label.empty()) {
      const Point& end = one.points.back();
      svg += circle(end, 0.26, filled(one.colour.c_str())) + "<text x=\"" + cm(end.x) + "\" y=\"" +
             cm(-end.y + 0.09) + "\" text-anchor=\"middle\" font-family=\"sans-serif\" " +
             "font-weight=\"700\" font-size=\"26\" fill=\"#16181b\">" + escaped(one.label) +
             "</text>";
      continue;
    }
    svg += circle(one.points.back(), 0.05,
                  "fill=\"" + one.colour + "\" fill-opacity=\"" + opacity + '"');
  }
  return svg + "</svg>\n";
}

}  // namespace pitchboard::link
