// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The contents of the dock with noise and physics. Window thread; the parent owns them.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// Every noise value and physics constant, with units; changes act at once.
QWidget* makeNoiseDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
