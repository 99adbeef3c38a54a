// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The contents of the variables dock. Window thread; the parent owns them.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// Every variable of every robot with its newest value; see docs/STUDIO.md, "Variables".
QWidget* makeVariablesDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
