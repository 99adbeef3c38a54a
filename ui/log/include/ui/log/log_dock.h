// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Log dock, with filters by text and level. It follows the newest entry until the user scrolls
// up. Entries can be copied and saved. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class ShownMoment;

/// All arguments must outlive the dock. A click on an entry of the source that is shown goes to its
/// moment. Entries after the moment shown are pale.
QWidget* makeLogDock(MatchController* controller, ShownMoment* shown, QWidget* parent);

}  // namespace pitchboard::ui
