// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field on the screen with a real match that stands still, and the mouse on it.

#include <QAction>
#include <QApplication>
#include <QContextMenuEvent>
#include <QGraphicsView>
#include <QMenu>
#include <QTest>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <memory>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/scenario/scenario.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "../support/menu_entry.h"

namespace field_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

class FieldRig {
 protected:
  void open() {
    link::MatchOptions options;
    options.cognition = link::Cognition::Inline;
    m_controller = std::make_unique<MatchController>(options);
    const auto scenario = link::loadScenario("match-3v3");
    QVERIFY2(scenario.has_value(), scenario ? "" : scenario.error().text().c_str());
    m_view = std::make_unique<FieldView>(m_controller.get());
    m_view->resize(900, 660);
    m_view->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_view.get()));
    m_controller->open(*scenario, true);
    QTRY_VERIFY(m_controller->frame() && m_controller->frame()->robots.size() == 6);
    m_canvas = m_view->findChild<QGraphicsView*>();
    QVERIFY(m_canvas);
    m_canvas->setFocus();
  }
  void close() {
    m_view.reset();
    m_controller.reset();
  }

  /// The context menu at a place of the field; null when there is none.
  QMenu* menuAt(const Point& place) {
    const QPoint point = at(place);
    QContextMenuEvent event(QContextMenuEvent::Mouse, point,
                            m_canvas->viewport()->mapToGlobal(point));
    QCoreApplication::sendEvent(m_canvas->viewport(), &event);
    return qobject_cast<QMenu*>(QApplication::activePopupWidget());
  }
  /// Triggers the action with this text of the context menu, also of a submenu.
  bool trigger(const Point& place, const QString& text) {
    auto* menu = menuAt(place);
    if (!menu) return false;
    QAction* found = menu_entry::called(menu->findChildren<QAction*>(), text);
    if (found != nullptr) found->trigger();
    menu->close();
    return found != nullptr;
  }
  bool isChecked(const Point& place, const QString& text) {
    auto* menu = menuAt(place);
    if (!menu) return false;
    bool checked = false;
    for (const QAction* action : menu->findChildren<QAction*>()) {
      checked = checked || (action->text() == text && action->isChecked());
    }
    menu->close();
    return checked;
  }
  Pose pose(int id) const {
    const link::RobotFrame* robot = m_controller->frame()->robot(RobotId{id});
    return robot != nullptr ? robot->pose : Pose{};
  }
  QPoint at(const Point& p) const {
    return m_canvas->viewportTransform().map(QPointF(p.x, p.y)).toPoint();
  }
  QPointF metres(const QPoint& p) const {
    return m_canvas->viewportTransform().inverted().map(QPointF(p));
  }
  static bool near(const Pose& a, const Pose& b) {
    return std::abs(a.position.x - b.position.x) < 1e-6 &&
           std::abs(a.position.y - b.position.y) < 1e-6;
  }
  // QTest::mouseMove() tells no buttons, which a drag needs.
  void moveTo(const QPoint& to, Qt::MouseButtons held = Qt::LeftButton,
              Qt::KeyboardModifiers modifiers = {}) {
    QMouseEvent event(QEvent::MouseMove, QPointF(to),
                      m_canvas->viewport()->mapToGlobal(QPointF(to)), Qt::NoButton, held,
                      modifiers);
    QCoreApplication::sendEvent(m_canvas->viewport(), &event);
  }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(m_canvas->viewport(), Qt::LeftButton, modifiers, from);
    for (int i = 1; i <= 5; ++i) moveTo(from + (to - from) * i / 5, Qt::LeftButton, modifiers);
    QTest::mouseRelease(m_canvas->viewport(), Qt::LeftButton, modifiers, to);
  }
  void wheel(const QPoint& point, int delta) {
    QWheelEvent event(QPointF(point), m_canvas->viewport()->mapToGlobal(QPointF(point)), {},
                      QPoint(0, delta), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(m_canvas->viewport(), &event);
  }

  std::unique_ptr<MatchController> m_controller;
  std::unique_ptr<FieldView> m_view;
  QGraphicsView* m_canvas = nullptr;
};

}  // namespace field_rig
