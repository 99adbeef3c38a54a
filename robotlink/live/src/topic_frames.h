// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Coordinate frames of ROS (tf2) in messages, and what their names usually mean. Private to live;
// pure functions.

#include <string>
#include <vector>

#include <robotlink/live/transform_tree.h>
#include <telemetry/recordings/recording.h>

namespace pitchboard::link {

/// Returns "robot3" of "robot3/base_link".
std::string prefixOf(const std::string& frame);
bool isFieldFrame(const std::string& frame);  ///< "map", "world"
bool isRobotFrame(const std::string& frame);  ///< "robot3/base_link"
/// Puts the transforms of a message into a tree; returns the frames that they place.
std::vector<std::string> takeTransforms(const telemetry::RecordedMessage& message,
                                        TransformTree& tree);

}  // namespace pitchboard::link
