// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot whose blackboard is read on this computer, as Live and recordings show it: what its board
// says becomes health, believed pose and ball, as if it had been heard. Pure functions.

#include <array>

#include <robotlink/frame/match_frame.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {

struct BoardHeard {
  double age = 0.0;   ///< s, of the newest sample
  double rate = 0.0;  ///< samples a second, while there is a segment
  std::uint64_t samples = 0;
  bool gone = false;  ///< the segment was removed
  bool poseKnown = false;
  sim::published_frame::CmPose pose;
  std::array<bool, telemetry::processCount> hasFlag{};  ///< the catalog has the process's flag
};

/// Into robot.health, pose and action; robot.board is there.
void fillBoardHealth(const sim::FieldSpec& field, const BoardHeard& heard, RobotFrame& robot);

}  // namespace pitchboard::link
