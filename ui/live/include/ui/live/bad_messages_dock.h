// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dock that lists received messages that could not be used, by kind, robot and sender, with the
// last text. UI thread only.

class QWidget;

namespace pitchboard::ui {

class LiveController;

/// `live` must outlive the dock.
QWidget* makeBadMessagesDock(LiveController* live, QWidget* parent);

}  // namespace pitchboard::ui
