// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A plain drawing of a frame, for reports made without a display: field, robots, ball, and what the
// robots believe as dashed circles. (The studio draws its own pictures.)

#include <string>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// An SVG document in the colours of the dark palette; 1 unit = 1 cm.
std::string fieldSvg(const MatchFrame& frame);

}  // namespace pitchboard::link
