// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A turn of the wheel as the desktop sends it: what ignores it hands it on to its parent, as a
// person sees it. GUI tests only.

#include <QtTest/qtestspontaneevent.h>
#include <QApplication>
#include <QWheelEvent>
#include <QWidget>

namespace pitchboard {

/// `delta`: eighths of a degree, 120 for a notch away from the hand.
inline void turnWheel(QWidget* at, QPoint position, int delta) {
  QWheelEvent event(position, at->mapToGlobal(position), {}, {0, delta}, Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QSpontaneKeyEvent::setSpontaneous(&event);
  qApp->notify(at, &event);
}

}  // namespace pitchboard
