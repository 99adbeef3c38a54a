// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Paints pictures and videos of the field without a window, for ./run and pitchboard-cli. They use
// the scene of the field, so that they look like the studio. Main thread; needs a QApplication.

#include "arguments.h"

namespace pitchboard::studio {

/// Paints a scenario's start into arguments.picture; returns the exit code.
int paintScenario(const Arguments& arguments, const link::Scenario& scenario, WindowSize within);
/// Paints a moment of a session, or a video of part of it. Prints the progress of a video to
/// stdout, as lines with a number from 0 to 1. Returns the exit code.
int paintSession(const Arguments& arguments, WindowSize within);

}  // namespace pitchboard::studio
