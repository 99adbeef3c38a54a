// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What was heard and could not be used: by kind, for each robot and each sender, with the last
// text. UI thread only.

class QWidget;

namespace pitchboard::ui {

class LiveController;

/// `live` must outlive the dock.
QWidget* makeBadMessagesDock(LiveController* live, QWidget* parent);

}  // namespace pitchboard::ui
