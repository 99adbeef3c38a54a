// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How sessions that are compared with the shown one are told apart on the field, in the timeline,
// in plots and in tables: each has a number from 1, with a colour and a mark of its own. The
// colours are neither those of teams nor those of curves. UI thread only.

#include <QColor>
#include <QString>

namespace pitchboard::ui {

inline constexpr int maxComparedSessions = 16;

/// The colour of a session in the current theme; `number`: 1 to maxComparedSessions.
QColor sessionColor(int number);
/// What stands behind the names of its robots and curves: ′ for the first, ′₂ for the second. 0, an
/// abandoned future of the same match, has that of the first.
QString sessionMark(int number);

}  // namespace pitchboard::ui
