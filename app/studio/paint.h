// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures and videos of the field without a window, for ./run and pitchboard-cli: painted by the
// field's own scene, so that they look like the studio. Main thread, with a QApplication.

#include "arguments.h"

namespace pitchboard::studio {

/// Paints a scenario's start into arguments.picture; returns the exit code.
int paintScenario(const Arguments& arguments, const link::Scenario& scenario, WindowSize within);
/// Paints a moment of a session, or a video of a part of it; a video's progress goes to stdout as
/// lines with the share that is done. Returns the exit code.
int paintSession(const Arguments& arguments, WindowSize within);

}  // namespace pitchboard::studio
