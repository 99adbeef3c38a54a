// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The menu of sessions that are compared with the one that is shown. UI thread only.

class QMenu;

namespace pitchboard::ui {

class ComparedSession;
class ComparedSessions;

/// Adds what can be done with one session: align, show, open it, remove it. All must outlive the
/// menu.
void fillComparedMenu(QMenu* menu, ComparedSessions* all, ComparedSession* session);

}  // namespace pitchboard::ui
