// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field as a foxglove.SceneUpdate in JSON: lengths in m, the frame is that of the field (origin
// in its centre, x to the right goal, y up, z from the ground). Pure function; any thread.

#include <cstdint>
#include <string>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// `time` is in ns since 1970.
std::string sceneJson(const MatchFrame& frame, std::uint64_t time);

/// The JSON schema of what sceneJson() makes.
extern const char* const sceneSchema;

}  // namespace pitchboard::link
