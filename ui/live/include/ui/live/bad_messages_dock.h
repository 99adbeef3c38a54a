// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What was heard and could not be used: by kind, for each robot and each sender, with the last
// text.

#include <ui/sources/studio_context.h>

namespace pitchboard::ui {

QWidget* makeBadMessagesDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
