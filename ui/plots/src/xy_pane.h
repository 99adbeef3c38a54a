// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One variable over another, during the linked time range: a path on the field, a phase picture.

#include <QPointF>

#include "plot_pane.h"

namespace pitchboard::ui {

class ValueChart;

/// Points (x, y) at the times of x within the range; where rows are many, evenly chosen times. A
/// point with NaN breaks the line.
std::vector<QPointF> xyPoints(const ColumnView& x, const ColumnView& y, telemetry::TimeRange range,
                              std::size_t most);

class XyPane : public PlotPane {
  Q_OBJECT
 public:
  XyPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

  QWidget* surface() const override;
  bool isOverTime() const override { return false; }
  const std::vector<std::vector<QPointF>>& points() const { return m_points; }
  ValueLimits xLimits() const;
  ValueLimits yLimits() const;
  void extendMenu(QMenu* menu) override;

 protected:
  void draw() override;
  void restyle() override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void paintCurves(QPainter& painter);
  QPointF toView(const QPointF& value) const;
  QPointF toValue(const QPointF& view) const;
  void showAll();

  ValueChart* m_chart;
  std::vector<std::vector<QPointF>> m_points;
  bool m_fits = true;    // limits follow the points
  ValueLimits m_x, m_y;  // when they do not
  QPointF m_last;
  bool m_dragging = false;
};

}  // namespace pitchboard::ui
