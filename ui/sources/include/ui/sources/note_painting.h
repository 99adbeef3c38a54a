// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Paints drawn notes, and finds the one at a place: on the screen, in pictures and in exported
// videos alike. Pixels are those of the painter. Pure functions; UI thread only.

#include <QPainterPath>
#include <QTransform>
#include <span>

#include <telemetry/session/drawn_notes.h>

class QPainter;

namespace pitchboard::ui {

/// `toPixels` leads from the coordinates of the note to pixels. `strength`: 1, or less for one that
/// is of another moment.
void paintNote(QPainter& painter, const telemetry::DrawnNote& note, const QTransform& toPixels,
               double strength = 1.0);
/// Paints those notes of the field that are shown at this time.
void paintFieldNotes(QPainter& painter, std::span<const telemetry::DrawnNote> notes,
                     const QTransform& toPixels, double time);
/// The same for a video that fills this rectangle; `name` is that of its file.
void paintVideoNotes(QPainter& painter, std::span<const telemetry::DrawnNote> notes,
                     const std::string& name, const QRectF& rect, double time);
/// Returns where the pointer takes hold of the note.
QPainterPath outlineOf(const telemetry::DrawnNote& note, const QTransform& toPixels);
/// Returns the transform from shares of a rectangle to pixels.
QTransform fromShares(const QRectF& rect);

}  // namespace pitchboard::ui
