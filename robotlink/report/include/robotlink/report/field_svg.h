// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A plain drawing of a frame, for reports made without a display: field, robots, ball, what the
// robots believe as dashed circles, and what their programs drew. (The studio draws its own
// pictures.)

#include <span>
#include <string>
#include <vector>

#include <simcore/world/field.h>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// An SVG document in the colours of the dark palette; 1 unit = 1 cm.
std::string fieldSvg(const MatchFrame& frame);

/// A way on the field, m.
struct FieldWay {
  std::vector<Point> points;
  std::string colour;  ///< of SVG
  double opacity = 1.0;
  double width = 3.0;  ///< cm
  bool marksEnd = false;
};
/// The field with ways of robots and balls of many runs, in the order in which they are painted.
std::string fieldSvg(const sim::FieldSpec& field, std::span<const FieldWay> ways);

}  // namespace pitchboard::link
