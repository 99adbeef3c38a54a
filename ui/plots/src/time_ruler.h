// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What stands above and below the plots of a page and runs over all of them: the heads of the A and
// B marks, the numbers of the time axis, and the lines of marks, of the moment shown and of the
// pointer. UI thread only.

#include <QWidget>
#include <functional>
#include <optional>

#include <ui/base/time_axis.h>
#include <ui/sources/linked_time.h>

#include "curve_trace.h"

namespace pitchboard::ui {

class TimeGestures;

/// Numbers of the linked time axis, and the times of pointer and moment; below the lowest plot.
class TimeRuler : public QWidget {
  Q_OBJECT
 public:
  TimeRuler(const PlotFeed* feed, std::function<TimeAxis()> axis, QWidget* parent);
  QSize sizeHint() const override;
  /// Without the times of pointer and moment.
  void setForPicture(bool on) { m_forPicture = on; }
  /// The numbers that are drawn: those that a time of pointer or moment would cover are not.
  std::vector<AxisTick> labels() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  /// The time of pointer or moment.
  struct Tag {
    QRectF box;
    QString text;
    bool isMoment = false;
  };
  std::vector<Tag> tags() const;

  const PlotFeed* m_feed;
  std::function<TimeAxis()> m_axis;
  bool m_forPicture = false;
};

/// Heads of A and B, which can be dragged; there is no row while there are no marks.
class MarkHeads : public QWidget {
  Q_OBJECT
 public:
  MarkHeads(LinkedTime* time, std::function<TimeAxis()> axis, QWidget* parent);
  QSize sizeHint() const override;
  QRectF headRect(TimeMark mark) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  LinkedTime* m_time;
  std::function<TimeAxis()> m_axis;
  std::optional<TimeMark> m_dragged;
};

/// Where something that is dragged over a page would go.
struct DropHint {
  QRect area;    ///< of the plot it would join, or the line of a new one
  QString text;  ///< "add to this plot", "new plot"
  bool operator==(const DropHint&) const = default;
};

/// Round times of the axis, for its numbers and for the grid above them.
std::vector<AxisTick> ticksOf(const TimeAxis& axis, const PlotFeed& feed, const QWidget* widget);

/// The value under the pointer, as a line across its plot.
struct PointedValue {
  double y = 0.0;
  QString text;
  bool operator==(const PointedValue&) const = default;
};

/// Lines of marks, of the moment shown and of the pointer over all plots; lets the mouse through.
class TimeLines : public QWidget {
  Q_OBJECT
 public:
  TimeLines(LinkedTime* time, std::function<TimeAxis()> axis, QWidget* parent);
  void setHint(const std::optional<DropHint>& hint);
  const std::optional<DropHint>& hint() const { return m_hint; }
  /// Each plot that has the time axis, in this widget.
  void setPlots(const QList<QRect>& plots);
  void setPointed(const std::optional<PointedValue>& value);
  const std::optional<PointedValue>& pointed() const { return m_pointed; }
  /// For a picture that others look at: marks stay, what follows moment and pointer goes.
  void setForPicture(bool on) { m_forPicture = on; }
  /// Redraws what has moved since the last time.
  void follow();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QList<double> places() const;

  LinkedTime* m_time;
  std::function<TimeAxis()> m_axis;
  QList<double> m_drawn;  // x of each line
  std::optional<DropHint> m_hint;
  QList<QRect> m_plots;
  std::optional<PointedValue> m_pointed;
  bool m_forPicture = false;
};

}  // namespace pitchboard::ui
