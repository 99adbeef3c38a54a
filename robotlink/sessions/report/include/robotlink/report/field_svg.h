// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Draws the field with the trajectories of many runs as SVG, for reports of experiments, which do
// not need the studio. (Pictures of a moment are painted by the studio: docs/sessions.md.) Pure
// function; any thread.

#include <span>
#include <string>
#include <vector>

#include <simcore/world/field.h>

namespace pitchboard::link {

/// The path of something on the field in m; its end is marked.
struct FieldTrajectory {
  std::vector<Point> points;
  std::string colour;  ///< a colour of SVG
  double opacity = 1.0;
  double width = 0.03;  ///< m
  std::string label{};  ///< of a robot: a disc with this text is drawn at the end
};

/// Returns an SVG document in the colours of the dark palette; 1 unit is 1 cm. Later trajectories
/// are painted over earlier ones. `below`: SVG in this drawing's units, under the field's lines.
std::string fieldSvg(const sim::FieldSpec& field, std::span<const FieldTrajectory> trajectories,
                     const std::string& below = {});

}  // namespace pitchboard::link
