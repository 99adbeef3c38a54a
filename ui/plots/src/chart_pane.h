// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Curves over the linked time axis.

#include <span>

#include "plot_pane.h"

namespace pitchboard::ui {

class NoteLayer;
class TimeGestures;
class ValueChart;

class ChartPane : public PlotPane {
  Q_OBJECT
 public:
  ChartPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

  QWidget* surface() const override;
  int wantedLeft() const override;
  int wantedRight() const override;
  QString pointedText(QPointF at) const override;
  void setBoxTool(bool on) override;
  /// What is drawn of each curve, in the order of curves().
  const std::vector<CurveTrace>& traces() const { return m_traces; }
  /// The same of a compared session, at the times of what is shown; nothing in those that it does
  /// not have. `session`: as in PlotFeed::compared().
  std::span<const CurveTrace> comparedTraces(std::size_t session = 0) const;
  ValueScale valueScale() const;
  /// Of the second axis; that of the first one while no curve is read there.
  ValueScale rightScale() const;
  bool hasRightAxis() const;
  /// What the drawing does not say by itself, at its upper right.
  QStringList captions() const;
  void extendMenu(QMenu* menu) override;

 protected:
  void draw() override;
  void restyle() override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void paintCurves(QPainter& painter) const;
  void shape();
  struct Extent {
    bool any = false;
    double low = 0.0, high = 0.0;
    void take(const CurveTrace& trace, double factor);
  };
  /// Of the curves at one of the two axes, as far as visible.
  Extent extent(bool right) const;
  void traceCompared(telemetry::TimeRange range, int columns);
  bool isDrawn(const ComparedRows& session, std::size_t index) const;
  void setValues(ValueLimits limits);
  void showNotes();
  /// The curve that is nearest to this place of the surface; -1: there is none.
  int curveAt(const QPointF& at) const;
  std::optional<QTransform> noteTransform(const std::string& variable) const;

  ValueChart* m_chart;
  TimeGestures* m_gestures;
  NoteLayer* m_notes = nullptr;  // null: nothing can be drawn
  // What is painted, complete before painting begins: it is done on several threads.
  struct Shape {
    std::vector<QPolygonF> lines;
    TraceLook look;
  };
  std::vector<CurveTrace> m_traces;
  std::vector<CurveTrace> m_comparedTraces;       // all curves of the first session, and so on
  std::vector<Shape> m_shapes, m_comparedShapes;  // of the traces
  struct Caption {
    QString text;
    QRectF place;
    QFont font;
    QColor color;
  };
  Caption m_caption;  // captions(), at the upper right
  TimeAxis m_shapedFor;
  std::pair<int, int> m_wanted;  // wantedLeft() and wantedRight(), as the page was told
};

}  // namespace pitchboard::ui
