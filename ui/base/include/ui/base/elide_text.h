// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shortens a line of text so that it fits, without showing a wrong number: text may be cut, but
// never a number with its unit. Pure function; any thread.

#include <QFontMetricsF>
#include <QString>

namespace pitchboard::ui {

/// Turns "offline 4 min 20 s" into "of… 4 min 20 s". If even the numbers do not fit, whole numbers
/// are left out from the end, and the last one loses its unit; if it still does not fit, only "…"
/// is left. Short names (B1, 2nd) count as numbers. `width` is in pixels.
QString elideText(const QFontMetricsF& metrics, const QString& text, double width);

/// Turns "VISION_BALL_DIST B1" into "BALL_DIST B1": of the name of a variable, the part that it
/// shares with others goes first, and the middle of what is left only after that.
QString elideName(const QFontMetricsF& metrics, const QString& name, double width);

}  // namespace pitchboard::ui
