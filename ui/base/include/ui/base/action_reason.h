// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Grey commands that say why. FlatStyle shows the tooltips of every menu. UI thread.

#include <QString>

class QAction;

namespace pitchboard::ui {

/// Enables the action if `whyNot` is empty. Otherwise the action is grey and its tooltip is the
/// reason, until the next call without one gives the action its own tooltip back.
void enableUnless(QAction& action, const QString& whyNot);

}  // namespace pitchboard::ui
