// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/belief.h>

#include <cmath>

#include <base/angles.h>
#include <simcore/published_frame.h>

namespace pitchboard::link {

std::optional<Pose> believedPose(const sim::FieldSpec& field, const RobotBoardView& board) {
  if (!board.localizationWorking) return {};
  return sim::published_frame::studioFromLocalization(
      field, {static_cast<double>(board.localizationX), static_cast<double>(board.localizationY),
              static_cast<double>(board.localizationTheta)});
}

std::optional<Point> perceivedBall(const sim::FieldSpec& field, const RobotBoardView& board,
                                   const Pose& origin) {
  const double range = sim::published_frame::metresFromCm(static_cast<double>(board.ballDistCm));
  const double bearing = radiansFromDegrees(static_cast<double>(board.panDeg));
  // Beyond twice the field it is no ball, whatever the vision says.
  const bool seen = board.visionWorking && !board.visionLost && range > 0.0 &&
                    range < 2 * field.length && std::isfinite(bearing);
  if (!seen) return {};
  return Point{origin.position.x + range * std::cos(origin.yaw + bearing),
               origin.position.y + range * std::sin(origin.yaw + bearing)};
}

}  // namespace pitchboard::link
