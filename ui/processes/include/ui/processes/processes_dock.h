// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The contents of the dock with the robots' processes. Window thread; the parent owns them.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// Table of the robots' processes; restart and stop in its context menu.
QWidget* makeProcessesDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
