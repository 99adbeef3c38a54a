// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drawings that a robot's program sends: named layers of lines, arrows, circles, polygons, points
// and texts in a datagram of text (docs/drawings.md describes the format). Plain values and pure
// functions, in metres and seconds; any thread. An accepted drawing never exceeds DrawingLimits.

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
  static constexpr std::size_t layers = 32;           ///< per robot and per datagram
  static constexpr std::size_t nameBytes = 48;        ///< length of a layer's name
  static constexpr std::size_t textBytes = 120;       ///< length of a text
  static constexpr std::size_t shapes = 1000;         ///< per layer
  static constexpr std::size_t points = 4000;         ///< per layer
  static constexpr std::size_t robotPoints = 20'000;  ///< per robot, in all layers
  static constexpr std::size_t robots = 64;
  static constexpr double farthest = 1000.0;  ///< m, largest coordinate or radius
  static constexpr double maxLife = 10.0;     ///< s
  static constexpr double widest = 20.0;      ///< pixels
};

/// The frame of a layer's coordinates.
enum class DrawingFrame : std::uint8_t {
  Field,  ///< the studio's frame (CONVENTIONS.md)
  Robot,  ///< origin at the robot, x ahead, y to its left
  Belief  ///< origin where it believes to be, x ahead, y to its left
};

enum class ShapeKind : std::uint8_t { Line, Arrow, Circle, Disc, Polygon, Area, Point, Text };

struct DrawingShape {
  ShapeKind kind = ShapeKind::Line;
  std::vector<Point> points;            ///< a single one for circles, points and texts
  double radius = 0.0;                  ///< m; circles and discs
  std::optional<std::uint32_t> colour;  ///< 0xAARRGGBB; nothing for the team's colour
  double width = 2.0;                   ///< of lines, in pixels
  std::string text;
  bool operator==(const DrawingShape&) const = default;
};

struct DrawingLayer {
  static constexpr double defaultLife = 1.0;
  std::string name;
  DrawingFrame frame = DrawingFrame::Field;
  double life = defaultLife;  ///< s after which it disappears unless it is drawn again
  bool adds = false;          ///< add to the layer instead of replacing it
  std::vector<DrawingShape> shapes;
  std::size_t points() const;
  bool operator==(const DrawingLayer&) const = default;
};

/// The content of one datagram.
struct Drawing {
  int robot = 1;            ///< its number, as in its telemetry
  std::optional<int> team;  ///< number of its team in the GameController, if given
  std::vector<DrawingLayer> layers;
  bool operator==(const Drawing&) const = default;
};

/// Reads a drawing. Fails with ParseError, which names the line and what was expected there.
Result<Drawing> parseDrawing(std::string_view text);
/// Returns the text that parseDrawing() reads back to the same drawing.
std::string drawingText(const Drawing& drawing);

/// Splits a robot's datagram, which is a message, a drawing, or a message followed by a drawing.
/// The parts point into `datagram`.
struct DatagramParts {
  std::string_view message, drawing;
};
DatagramParts partsOf(std::string_view datagram);

}  // namespace pitchboard::telemetry
