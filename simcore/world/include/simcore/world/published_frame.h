// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts between the studio's frame (metres, radians, origin at the centre of the field, +x
// right, +y up) and the two published frames (centimetres, degrees, y down): the window of the
// published simulator, whose origin lies 70 cm outside the field, and the localization variables,
// whose origin is the top-left corner of the field. No other file converts between them. Pure
// functions; any thread.

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::sim::published_frame {

/// A pose in centimetres and degrees. y points down; angles are counter-clockwise on the screen.
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
// A published speed is in centimetres per frame of 1/60 s.
constexpr double mpsFromCmPerFrame(double v) {
  return v * framesPerSecond / 100.0;
}
constexpr double cmPerFrameFromMps(double v) {
  return v * 100.0 / framesPerSecond;
}

// Window of the published simulator; `degrees` is in [0, 360).
CmPose windowFromStudio(const FieldSpec& field, const Pose& pose);
Pose studioFromWindow(const FieldSpec& field, const CmPose& window);
Point studioFromWindow(const FieldSpec& field, double x_cm, double y_cm);

// LOCALIZATION_X, _Y and _THETA; `degrees` is in (−180, 180].
CmPose localizationFromStudio(const FieldSpec& field, const Pose& pose);
Pose studioFromLocalization(const FieldSpec& field, const CmPose& localization);

}  // namespace pitchboard::sim::published_frame
