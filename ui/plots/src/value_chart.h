// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A Qt chart with two value axes. The series of an XY plot are Qt's. Long curves over time are
// painted by a function instead: Qt's line series takes every row as a point and keeps all of them
// (compared by line_series in tests/benchmarks/bench_plots.cpp). Grid, numbers and titles are
// painted here: Qt makes an item and a text document of each, and makes them anew whenever limits
// or size change, which is in every picture of a plot that follows. UI thread only.

#include <QChartView>
#include <functional>

#include <ui/plots/axis_ticks.h>

class QAbstractSeries;
class QValueAxis;

namespace pitchboard::ui {

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
  /// Numbers under the x axis: of an XY plot, not of a time axis that others label.
  void setLabelsX(bool on);
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
  /// The curves have changed: paint them anew at the next opportunity.
  void redraw();

 signals:
  void resized();

 protected:
  void drawBackground(QPainter* painter, const QRectF& exposed) override;
  void drawForeground(QPainter* painter, const QRectF& rect) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Layer;
  void place();
  static int widestNumber(const ValueLimits& limits, double step);
  static QColor gridColor();
  void paintAcross(QPainter& painter) const;
  void paintUp(QPainter& painter, const ValueLimits& limits, double step, bool right) const;
  void paintTitles(QPainter& painter) const;

  // Of series, from the first one on.
  QValueAxis* m_axisX = nullptr;
  QValueAxis* m_axisY = nullptr;
  Layer* m_layer;
  QMargins m_margins;
  QRectF m_area;
  ValueLimits m_x, m_y, m_right;
  double m_stepX = 0.0, m_stepY = 0.0, m_stepRight = 0.0;
  double m_anchorX = 0.0;
  bool m_labelsX = false, m_hasRight = false;
  QString m_titleX, m_titleY, m_titleRight;
};

}  // namespace pitchboard::ui
