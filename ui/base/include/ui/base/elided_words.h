// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shortens a line that is wider than its place without telling a wrong number: words are cut, a
// number with its unit never is. Free function, any thread.

#include <QFontMetricsF>
#include <QString>

namespace pitchboard::ui {

/// "silent 4 min 20 s" becomes "si… 4 min 20 s". Where even the numbers do not fit, whole ones
/// leave from the end, and a single one gives up its unit; "…" is all that is left of a number that
/// is wider than the place. Short names (B1, 2nd) count as numbers. `width` in pixels.
QString elidedWords(const QFontMetricsF& metrics, const QString& text, double width);

}  // namespace pitchboard::ui
