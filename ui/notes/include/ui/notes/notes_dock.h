// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Notes: lists the notes and bookmarks of the source that is shown. A click leads to the
// moment; texts are changed in the list, notes are deleted, and all of them are saved as a table.
// UI thread only.

class QWidget;

namespace pitchboard::ui {

class NoteBoard;

/// The board must outlive the dock.
QWidget* makeNotesDock(NoteBoard* board, QWidget* parent);

}  // namespace pitchboard::ui
