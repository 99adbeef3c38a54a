// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Codes and flags over the linked time axis: a lane for each, stretches with their labels.

#include "plot_pane.h"

namespace pitchboard::ui {

class TimeGestures;

/// A time during which a code did not change.
struct LaneStretch {
  double begin = 0.0;  ///< s
  double end = 0.0;    ///< s
  double value = 0.0;  ///< NaN: nobody knows
  bool mixed = false;  ///< it changed too often to be shown at this zoom
  bool operator==(const LaneStretch&) const = default;
};

/// Stretches within `range`, not beyond the column's last row; `columns`: pixels of the range.
std::vector<LaneStretch> laneStretches(const ColumnView& view, telemetry::TimeRange range,
                                       int columns);

class LanePane : public PlotPane {
  Q_OBJECT
 public:
  LanePane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

  QWidget* surface() const override;
  QList<QRect> lineAreas() const override;
  void setBoxTool(bool on) override;
  /// Of the lane at this place, in the order of curves().
  const std::vector<LaneStretch>& stretches(std::size_t lane) const { return m_stretches[lane]; }
  /// The same of a compared session, at the times of what is shown: a band at the lane's foot.
  /// `session`: as in PlotFeed::compared().
  const std::vector<LaneStretch>& comparedStretches(std::size_t lane,
                                                    std::size_t session = 0) const;
  /// Returns the session and the state at this place of the surface as a sentence; empty if it is
  /// on no band of a compared session.
  QString tipAt(QPointF at) const;

 protected:
  void draw() override;
  bool wantsLegend() const override { return false; }

 private:
  class Lanes;
  void paintLanes(QPainter& painter) const;
  void paintCompared(QPainter& painter, std::size_t lane, const QRectF& place) const;
  void fitHeight();
  int laneAt(double y) const;
  /// px; of a lane with its bands, of it with its name and gap, and of a band.
  int laneHigh() const;
  int rowHigh() const;
  int bandHigh() const;

  Lanes* m_lanes;
  TimeGestures* m_gestures;
  std::vector<std::vector<LaneStretch>> m_stretches;
  std::vector<std::vector<LaneStretch>> m_comparedStretches;  // all lanes of the first session, …
};

}  // namespace pitchboard::ui
