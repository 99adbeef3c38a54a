// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

/// Every variable of every robot with its newest value; see docs/STUDIO.md, "Variables".
QWidget* makeVariablesDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
