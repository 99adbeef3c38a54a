// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Curves over the linked time axis.

#include "plot_pane.h"

namespace pitchboard::ui {

class TimeGestures;
class ValueChart;

class ChartPane : public PlotPane {
  Q_OBJECT
 public:
  ChartPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

  QWidget* surface() const override;
  int wantedLeft() const override;
  void setBoxTool(bool on) override;
  /// What is drawn of each curve, in the order of curves().
  const std::vector<CurveTrace>& traces() const { return m_traces; }
  ValueScale valueScale() const;
  void extendMenu(QMenu* menu) override;

 protected:
  void draw() override;
  void restyle() override;

 private:
  void paintCurves(QPainter& painter) const;
  void shape();
  void setValues(ValueLimits limits);

  ValueChart* m_chart;
  TimeGestures* m_gestures;
  // What is painted, complete before painting begins: it is done on several threads.
  struct Shape {
    std::vector<QPolygonF> lines;
    TraceLook look;
  };
  std::vector<CurveTrace> m_traces;
  std::vector<Shape> m_shapes;  // of the traces
  TimeAxis m_shapedFor;
};

}  // namespace pitchboard::ui
