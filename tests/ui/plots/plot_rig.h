// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The dock of plots on the screen with values of robots, and the drops, wheels and drags of a
// person.

#include <QDropEvent>
#include <QMimeData>
#include <QTest>

#include <simcore/world/action_codes.h>
#include <ui/base/theme.h>
#include <ui/plots/plots_dock.h>

#include "legend_bar.h"
#include "marks_model.h"
#include "marks_panel.h"
#include "plot_page.h"
#include "plot_source.h"

namespace plot_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

inline void dropOn(QWidget* page, const QStringList& names, const QPoint& at) {
  QMimeData data;
  data.setData(variablesMimeType, names.join('\n').toUtf8());
  QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(page, &enter);
  QVERIFY(enter.isAccepted());
  QDragMoveEvent move(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(page, &move);
  QVERIFY(move.isAccepted());
  QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(page, &drop);
  QVERIFY(drop.isAccepted());
}

inline void wheel(QWidget* at, const QPoint& position, int notches,
                  Qt::KeyboardModifiers keys = {}) {
  QWheelEvent event(position, at->mapToGlobal(position), {}, {0, 120 * notches}, Qt::NoButton, keys,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(at, &event);
}

inline void drag(QWidget* at, QPoint from, QPoint to, Qt::KeyboardModifiers keys = {}) {
  QTest::mousePress(at, Qt::LeftButton, keys, from);
  for (int i = 1; i <= 4; ++i) {
    QMouseEvent move(QEvent::MouseMove, from + (to - from) * i / 4,
                     at->mapToGlobal(from + (to - from) * i / 4), Qt::NoButton, Qt::LeftButton,
                     keys);
    QApplication::sendEvent(at, &move);
  }
  QTest::mouseRelease(at, Qt::LeftButton, keys, to);
}

/// A dock on the screen with a source of 30 s of B1.
struct Shown : PlotBench {
  explicit Shown(double seconds = 30.0) {
    if (seconds > 0) source.fill("B1", seconds);
    dock = std::make_unique<PlotsDock>(context(), nullptr);
    dock->resize(1000, 400);
    dock->show();
    QVERIFY2(QTest::qWaitForWindowExposed(dock.get()), "the dock is not on the screen");
    dock->feed()->refresh();
  }
  PlotPage* page() const { return dock->currentPage(); }
  PlotPane* pane(int i = 0) const { return page()->panes().value(i); }
  QPoint middleOf(const QWidget* widget) const {
    return widget->mapTo(page(), widget->rect().center());
  }
  /// Adds by a drop on the empty page.
  PlotPane* dropped(const QStringList& names) {
    dropOn(page(), names, page()->rect().center());
    QCoreApplication::processEvents();
    return page()->panes().last();
  }
  std::unique_ptr<PlotsDock> dock;
};

/// A dock on the screen with ten seconds of some robots.
struct Bench : PlotBench {
  std::unique_ptr<PlotsDock> dock;
  explicit Bench(const QStringList& robots = {QStringLiteral("B1"), QStringLiteral("B2")}) {
    for (const QString& robot : robots) source.fill(robot.toUtf8().constData(), 10.0);
    dock = std::make_unique<PlotsDock>(context(), nullptr);
    dock->resize(1000, 300);
    dock->show();
    dock->feed()->refresh();
  }
  PlotPane* show(const CurveSpec& curve) {
    PaneSpec pane;
    pane.curves << curve;
    return dock->currentPage()->insertPane(0, pane);
  }
};

inline CurveSpec expression(const QString& text) {
  CurveSpec curve;
  curve.kind = CurveKind::Expression;
  curve.expression = text;
  return curve;
}

inline QStringList namesOf(const PlotPane* pane) {
  QStringList names;
  for (const Curve& curve : pane->curves()) names << curve.name();
  return names;
}

}  // namespace plot_rig
