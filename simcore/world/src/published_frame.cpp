// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/published_frame.h>

#include <cmath>

#include <base/angles.h>

namespace pitchboard::sim::published_frame {

CmPose windowFromStudio(const FieldSpec& field, const Pose& pose) {
  double degrees = std::fmod(degreesFromRadians(pose.yaw), 360.0);
  if (degrees < 0.0) degrees += 360.0;
  return {cmFromMetres(pose.position.x + field.halfLength() + field.border),
          cmFromMetres(field.halfWidth() + field.border - pose.position.y), degrees};
}

Pose studioFromWindow(const FieldSpec& field, const CmPose& window) {
  return {studioFromWindow(field, window.x, window.y),
          wrapToPi(radiansFromDegrees(window.degrees))};
}

Point studioFromWindow(const FieldSpec& field, double x_cm, double y_cm) {
  return {metresFromCm(x_cm) - field.halfLength() - field.border,
          field.halfWidth() + field.border - metresFromCm(y_cm)};
}

CmPose localizationFromStudio(const FieldSpec& field, const Pose& pose) {
  return {cmFromMetres(pose.position.x + field.halfLength()),
          cmFromMetres(field.halfWidth() - pose.position.y),
          degreesFromRadians(wrapToPi(pose.yaw))};
}

Pose studioFromLocalization(const FieldSpec& field, const CmPose& localization) {
  return {{metresFromCm(localization.x) - field.halfLength(),
           field.halfWidth() - metresFromCm(localization.y)},
          wrapToPi(radiansFromDegrees(localization.degrees))};
}

}  // namespace pitchboard::sim::published_frame
