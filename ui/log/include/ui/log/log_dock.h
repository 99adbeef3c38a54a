// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The contents of the log dock. Window thread; the parent owns them.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// The log with a filter of words; follows the newest line until one scrolls up; Ctrl+C copies.
QWidget* makeLogDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
