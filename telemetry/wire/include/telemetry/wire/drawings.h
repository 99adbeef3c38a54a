// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's program draws on the field: named layers of lines, arrows, circles, polygons,
// points and texts, as one datagram of text says it (docs/drawings.md has the format). Plain
// values and pure functions; metres, seconds. Whatever is refused is refused with a sentence, and
// nothing that is accepted is larger than DrawingLimits.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <base/result.h>

namespace pitchboard::telemetry {

struct DrawingLimits {
  static constexpr std::size_t layers = 32;           ///< of a robot, and of a datagram
  static constexpr std::size_t nameBytes = 48;        ///< of a layer's name
  static constexpr std::size_t textBytes = 120;       ///< of one text
  static constexpr std::size_t shapes = 1000;         ///< of a layer
  static constexpr std::size_t points = 4000;         ///< of a layer
  static constexpr std::size_t robotPoints = 20'000;  ///< of all layers of a robot
  static constexpr std::size_t robots = 64;
  static constexpr double farthest = 1000.0;   ///< m, of a coordinate or a radius
  static constexpr double longestLife = 10.0;  ///< s
  static constexpr double widest = 20.0;       ///< pixels
};

/// What a layer's coordinates count from.
enum class DrawingFrame : std::uint8_t {
  Field,  ///< the studio's frame (CONVENTIONS.md)
  Robot,  ///< x ahead and y to the left of where the robot stands
  Belief  ///< the same of where it believes to stand
};

enum class ShapeKind : std::uint8_t { Line, Arrow, Circle, Disc, Polygon, Area, Point, Text };

struct DrawingShape {
  ShapeKind kind = ShapeKind::Line;
  std::vector<Point> points;            ///< one of circles, points and texts
  double radius = 0.0;                  ///< m, of circles
  std::optional<std::uint32_t> colour;  ///< 0xAARRGGBB; nothing: the team's
  double width = 2.0;                   ///< of strokes, pixels
  std::string text;
  bool operator==(const DrawingShape&) const = default;
};

struct DrawingLayer {
  static constexpr double usualLife = 1.0;
  std::string name;
  DrawingFrame frame = DrawingFrame::Field;
  double life = usualLife;  ///< s; then it goes, unless it was drawn again
  bool adds = false;        ///< to what the layer shows already, instead of replacing it
  std::vector<DrawingShape> shapes;
  std::size_t points() const;
  bool operator==(const DrawingLayer&) const = default;
};

/// One datagram.
struct Drawing {
  int robot = 1;            ///< the number that its telemetry has
  std::optional<int> team;  ///< the referee's number of its team, where the datagram says it
  std::vector<DrawingLayer> layers;
  bool operator==(const Drawing&) const = default;
};

/// Error ParseError with the line and what it should be.
Result<Drawing> parseDrawing(std::string_view text);
/// As it is sent; parseDrawing() gives the same drawing again.
std::string drawingText(const Drawing& drawing);

/// A robot's datagram is a message, a drawing, or a message with a drawing behind it.
struct DatagramParts {
  std::string_view message, drawing;
};
DatagramParts partsOf(std::string_view datagram);

}  // namespace pitchboard::telemetry
