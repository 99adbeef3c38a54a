// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The planning process, between decision and control: reads decision's target, the pose and where
// others stand, writes the path and the action. It acts only while decision has set a target, so
// that a robot whose decision kicks or turns by itself is left alone. Ten times a second.

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

Result<std::unique_ptr<CognitiveProcess>> makePlanning(const ProcessOptions& options);

}  // namespace pitchboard::link
