// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One variable over another, during the linked time range: a path on the field, a phase picture.

#include <QList>
#include <QPointF>

#include "plot_pane.h"

class QLineSeries;
class QScatterSeries;

namespace pitchboard::ui {

class ValueChart;

/// Points (x, y) at the times of x within the range; where rows are many, evenly chosen times. A
/// point with NaN breaks the line.
std::vector<QPointF> xyPoints(const ColumnView& x, const ColumnView& y, telemetry::TimeRange range,
                              std::size_t most);

/// The unbroken stretches of `points`; when there are more than `most`, nothing.
std::optional<std::vector<QList<QPointF>>> stretchesOf(const std::vector<QPointF>& points,
                                                       std::size_t most);

class XyPane : public PlotPane {
  Q_OBJECT
 public:
  XyPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

  QWidget* surface() const override;
  bool isOverTime() const override { return false; }
  const std::vector<std::vector<QPointF>>& points() const { return m_points; }
  /// The same of a compared session, of the time that stands beside what is shown. `session`: as
  /// in PlotFeed::compared().
  const std::vector<QPointF>& comparedPoints(std::size_t curve, std::size_t session = 0) const;
  ValueLimits xLimits() const;
  ValueLimits yLimits() const;
  /// Titles of the lower and the left axis.
  const std::pair<QString, QString>& titles() const { return m_titles; }
  void extendMenu(QMenu* menu) override;

 protected:
  void draw() override;
  void restyle() override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// Limits and steps for points between these; false where there is no room to draw.
  bool layOutAxes(const ValueLimits& x, const ValueLimits& y);
  void showCurves();
  void showCurve(const CurveSpec& spec, const QColor& color, double width,
                 const std::vector<QPointF>& points, std::size_t& used, Qt::PenStyle pen);
  QLineSeries* nextLine(std::size_t& used);
  void showMarkers();
  void removeMarkers();
  QPointF toValue(const QPointF& view) const;
  void showAll();

  ValueChart* m_chart;
  std::vector<QLineSeries*> m_lines;       // owned by the chart; the first ones are in use
  std::vector<QScatterSeries*> m_markers;  // one for each curve, above the lines
  std::vector<std::vector<QPointF>> m_points;
  std::vector<std::vector<QPointF>> m_comparedPoints;  // all curves of the first session, and so on
  std::pair<QString, QString> m_titles;
  bool m_fits = true;    // limits follow the points
  ValueLimits m_x, m_y;  // when they do not
  QPointF m_last;
  bool m_dragging = false;
};

}  // namespace pitchboard::ui
