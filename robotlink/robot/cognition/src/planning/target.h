// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where decision sends planning, and how the two say it on the blackboard: in variables of the
// extension of the map (docs/blackboard.md), which programs that know only the published map never
// see. Metres and radians here, centimetres and degrees of the LOCALIZATION frame on the
// blackboard. Use from one thread.

#include <array>
#include <optional>
#include <span>

#include <base/geometry.h>
#include <robotlink/blackboard/robot_variables.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

struct Target {
  Pose pose;
  double near = 0.10;         ///< m, close enough
  double facing = 0.20;       ///< rad, turned well enough
  std::optional<Point> ball;  ///< to keep clear of
  bool forwards = false;      ///< walks no long way sideways or backwards
  bool apart = false;         ///< gives other robots more room than it needs
  /// Whether who stands at `pose` is there.
  bool isReached(const Pose& pose) const;
};

class TargetVariables {
 public:
  static constexpr int maxPathPoints = 16;

  TargetVariables();

  void write(Blackboard& board, const sim::FieldSpec& field, const Target& target) const;
  /// Nothing to walk to: decision acts by itself.
  void clear(Blackboard& board) const { writeIfPresent(board, m_wanted, none); }
  /// Nothing when there is none, or when its numbers make no sense.
  std::optional<Target> read(const Blackboard& board, const sim::FieldSpec& field) const;

  /// The bends of a path and its end; what does not fit is left out.
  void writePath(Blackboard& board, const sim::FieldSpec& field,
                 std::span<const Point> points) const;

 private:
  static constexpr int none = 0, walk = 1, roundBall = 2, forwards = 4,
                       apart = 8;  // DECISION_TARGET

  IntVar m_wanted, m_pathPoints;
  FloatVar m_x, m_y, m_theta, m_near, m_facing, m_ballX, m_ballY;
  std::array<FloatVar, maxPathPoints> m_pathX, m_pathY;
};

}  // namespace pitchboard::link
