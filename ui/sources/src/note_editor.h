// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Asks for the text of a note and how long it is shown. UI thread only.

#include <QDialog>
#include <functional>

#include <telemetry/session/drawn_notes.h>

namespace pitchboard::ui {

/// Opens the dialog at this place of the screen; `accept` gets the changed note, `remove` is called
/// if the user deletes it and may be empty for a new one.
void editNote(QWidget* parent, const QPoint& global, const telemetry::DrawnNote& note,
              const std::function<void(const telemetry::DrawnNote&)>& accept,
              const std::function<void()>& remove);

}  // namespace pitchboard::ui
