// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field as data: every length that drawing, physics and scenarios need. Metres; plain values;
// any thread.

#include <span>
#include <string>
#include <string_view>

#include <base/geometry.h>
#include <base/result.h>

namespace pitchboard::sim {

/// How a ball rolls. On the published simulator's surface it loses a share of its speed; on real
/// ones it loses the same speed every second.
struct Surface {
  double deceleration = 0.0;   ///< m/s²
  double keptPerFrame = 0.95;  ///< share of its speed that the ball keeps in 1/60 s
  bool operator==(const Surface&) const = default;
};

/// Returns how far a ball of this speed (m/s) rolls, in m; infinite if nothing slows it down.
double rollingDistance(const Surface& surface, double speed);

/// Lengths in metres. The field is symmetric about both axes; the origin is its centre.
struct FieldSpec {
  std::string name = "published";
  double length = 9.0;      ///< goal line to goal line, outer edges
  double width = 6.0;       ///< touch line to touch line
  double border = 0.7;      ///< from a line to the wall around the field
  double goalWidth = 1.8;   ///< between the centres of the posts
  double goalDepth = 0.7;   ///< from the goal line to the back of the goal
  double goalHeight = 1.1;  ///< not simulated: the simulation is flat
  double goalPostRadius = 0.10;
  double goalAreaLength = 0.6;     ///< along x
  double goalAreaWidth = 3.45;     ///< along y
  double penaltyAreaLength = 0.0;  ///< 0 = none
  double penaltyAreaWidth = 0.0;
  double penaltyMarkDistance = 1.8;  ///< from the goal line
  double centreCircleDiameter = 1.5;
  double lineWidth = 0.05;
  double markDiameter = 0.0;  ///< of the penalty and centre marks, if they are discs; 0 = crosses
  double cornerArcRadius = 0.0;  ///< to the outer edge; 0 = none
  double ballRadius = 0.09;
  double ballMass = 0.2;      ///< kg, unless the scenario says otherwise
  double robotRadius = 0.13;  ///< for robots whose model names none
  Surface surface;

  double halfLength() const { return length / 2; }
  double halfWidth() const { return width / 2; }
  bool operator==(const FieldSpec&) const = default;
};

/// Returns the built-in fields, the published one first (docs/scenarios.md).
std::span<const FieldSpec> builtInFields();
Result<FieldSpec> fieldByName(std::string_view name);

/// Fails with InvalidArgument for sizes that cannot be played on, such as a goal wider than the
/// field.
Result<void> validate(const FieldSpec& field);

}  // namespace pitchboard::sim
