// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Settings of a frame that a test makes up.

#include <robotlink/frame/match_frame.h>

/// A copy that is this frame's alone.
inline pitchboard::link::FrameSettings& ownSettings(pitchboard::link::MatchFrame& frame) {
  auto own = std::make_shared<pitchboard::link::FrameSettings>(*frame.settings);
  frame.settings = own;
  return *own;
}
