// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Opens the dialog that maps topics for who opens recordings of other programs and for Foxglove
// bridges, which do not know it. UI thread only.

#include <QStringList>

class QAction;
class QMenu;
class QWidget;

namespace pitchboard::ui {

class FoxgloveDialog;
class SessionFiles;

/// Says what the topics of recordings mean, and opens them again.
void mapRecordings(SessionFiles* sessions, const QStringList& recordings, QWidget* window);
/// Adds the action for the recordings that are open, or for others.
QAction* addMappingAction(QMenu* menu, SessionFiles* sessions, QWidget* window);
/// Opens the dialog when it is wanted.
void mapBridgesOf(FoxgloveDialog* dialog);

}  // namespace pitchboard::ui
