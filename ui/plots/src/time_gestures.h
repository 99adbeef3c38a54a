// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the mouse does over anything that has the linked time axis: the wheel zooms, dragging moves,
// a click shows that moment everywhere, hovering sets the cursor, which stays under a still pointer
// while times run along below it, and a mark near the pointer can be dragged. UI thread only.

#include <QObject>
#include <QPointF>
#include <QRectF>
#include <functional>
#include <optional>

#include <ui/sources/linked_time.h>

#include "curve_trace.h"

class QMouseEvent;
class QRubberBand;
class QWheelEvent;
class QWidget;

namespace pitchboard::ui {

/// By how much a turn of the wheel (QWheelEvent::angleDelta) zooms; below 1 is closer.
double wheelFactor(int turned);

class TimeGestures : public QObject {
  Q_OBJECT
 public:
  /// Watches `surface`, which owns this; `scale` says where times stand in it.
  TimeGestures(QWidget* surface, LinkedTime* time, std::function<TimeAxis()> axis);

  /// A drag without keys draws a box, as Shift-drag always does.
  void setBoxTool(bool on) { m_boxTool = on; }
  /// Boxes can choose values too (a chart), or only times (a lane).
  void setHasValues(bool on) { m_hasValues = on; }

  bool eventFilter(QObject* watched, QEvent* event) override;

 signals:
  /// Ctrl+wheel: factor < 1 is closer; y in the surface.
  void valueZoomed(double factor, double y);
  /// Dragged: pixels down since the last time.
  void valuePanned(double pixels);
  /// Shift-drag: the box in the surface. Times are set already.
  void boxDrawn(const QRectF& box);
  /// Double click.
  void fitRequested();
  /// Where the pointer is, in the surface; nothing: not over it.
  void pointed(std::optional<QPointF> at);

 private:
  void wheel(QWheelEvent* event);
  void press(QMouseEvent* event);
  void move(QMouseEvent* event);
  void release(QMouseEvent* event);
  void leave();
  void showCursor();
  std::optional<TimeMark> markAt(const QPointF& position) const;

  enum class Drag { None, Pan, Box, Mark };
  QWidget* m_surface;
  LinkedTime* m_time;
  std::function<TimeAxis()> m_axis;
  QRubberBand* m_band = nullptr;
  Drag m_drag = Drag::None;
  TimeMark m_mark = TimeMark::A;
  QPointF m_from, m_last;
  bool m_over = false;             // the pointer is over the surface, at m_last
  bool m_dragged = false;          // since the button went down: farther than a trembling hand
  std::optional<double> m_before;  // the moment shown before the last click
  bool m_boxTool = false;
  bool m_hasValues = true;
};

}  // namespace pitchboard::ui
