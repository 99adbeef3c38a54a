// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The contents of the timeline dock. Window thread; the parent owns them.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// The timeline with the button that leads back to now.
QWidget* makeTimelineDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
