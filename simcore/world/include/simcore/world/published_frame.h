// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ONE place that converts between the studio's frame (metres, radians, origin at the field's
// centre, +x right, +y up) and the published ones (centimetres, degrees, y down): the window of the
// published simulator (origin at the corner of its world, 70 cm outside the field) and the
// localization variables (origin at the field's top-left corner). system.md sections 3 to 5.

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim::published_frame {

/// A pose in centimetres and degrees, y down, angles counter-clockwise as seen.
struct CmPose {
  double x = 0.0;
  double y = 0.0;
  double degrees = 0.0;
};

constexpr double framesPerSecond = 60.0;

constexpr double metresFromCm(double cm) {
  return cm / 100.0;
}
constexpr double cmFromMetres(double metres) {
  return metres * 100.0;
}
/// m/s from cm per published frame of 1/60 s, and back.
constexpr double mpsFromCmPerFrame(double v) {
  return v * framesPerSecond / 100.0;
}
constexpr double cmPerFrameFromMps(double v) {
  return v * 100.0 / framesPerSecond;
}

/// Window coordinates. `degrees` comes out in [0, 360).
CmPose windowFromStudio(const FieldSpec& field, const Pose& pose);
Pose studioFromWindow(const FieldSpec& field, const CmPose& window);
Point studioFromWindow(const FieldSpec& field, double x_cm, double y_cm);

/// LOCALIZATION_X, _Y, _THETA: origin at the field's top-left corner; theta in (−180, 180].
CmPose localizationFromStudio(const FieldSpec& field, const Pose& pose);
Pose studioFromLocalization(const FieldSpec& field, const CmPose& localization);

}  // namespace pitchboard::sim::published_frame
