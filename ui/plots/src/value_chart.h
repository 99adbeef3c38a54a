// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A Qt chart with two value axes. Axes, grid, numbers and titles are Qt's, and so are the series of
// an XY plot. Long curves over time are painted by a function instead: Qt's line series takes every
// row as a point and keeps all of them (compared by line_series in
// tests/benchmarks/bench_plots.cpp). With them goes the grid of an x axis without numbers: Qt makes
// items again for every step of a time axis that follows. UI thread only.

#include <QChartView>
#include <functional>

#include <ui/plots/axis_ticks.h>

class QAbstractSeries;
class QValueAxis;

namespace pitchboard::ui {

/// px of the mock between a curve and the frame, which would hide it.
inline constexpr int frameRoom = 4;

class ValueChart : public QChartView {
  Q_OBJECT
 public:
  using Painter = std::function<void(QPainter&)>;
  /// Parts: the painter is called on several threads at once, each with a clip of its own, and
  /// paints what lies in that; the chart's thread waits meanwhile.
  enum class Painting { Whole, Parts };

  explicit ValueChart(QWidget* parent = nullptr);

  /// Where the curves are, in the view.
  QRectF plotArea() const { return m_area; }
  void setMargins(int left, int top, int right, int bottom);
  /// Grid lines on multiples of the steps; those of x counted from `xAnchor`.
  void setAxes(ValueLimits x, double xStep, ValueLimits y, double yStep, double xAnchor = 0.0);
  ValueLimits xLimits() const { return m_x; }
  ValueLimits yLimits() const { return m_y; }
  void setTitles(const QString& x, const QString& y, const QString& right = {});
  /// The x axis has numbers: of an XY plot, not of a time axis that others label.
  void labelX();
  /// The chart owns it from now on.
  void addSeries(QAbstractSeries* series);
  /// Room for the numbers of the y axis and its title, px.
  int wantedLeft() const;
  /// A second value axis at the right, without a grid.
  void setRightAxis(ValueLimits limits, double step);
  void hideRightAxis();
  ValueLimits rightLimits() const { return m_right; }
  int wantedRight() const;

  void setCurvePainter(Painter painter, Painting painting = Painting::Whole);
  /// The curves have changed: paint them again at the next opportunity.
  void redraw();
  void applyTheme();

 signals:
  void resized();

 protected:
  void drawForeground(QPainter* painter, const QRectF& rect) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Layer;
  void place();
  void placeGridX();
  void put(QValueAxis* axis, ValueLimits& now, const ValueLimits& to, double& step, double toStep);

  QValueAxis* m_axisX;
  QValueAxis* m_axisY;
  QValueAxis* m_axisRight;
  Layer* m_layer;
  QMargins m_margins;
  QRectF m_area;
  ValueLimits m_x, m_y, m_right;
  double m_stepX = 0.0, m_stepY = 0.0, m_stepRight = 0.0;
  double m_anchorX = 0.0;
};

}  // namespace pitchboard::ui
