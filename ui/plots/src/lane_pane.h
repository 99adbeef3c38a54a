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
  /// The same of the compared session, at the times of what is shown: a band at the lane's foot.
  const std::vector<LaneStretch>& comparedStretches(std::size_t lane) const {
    return m_comparedStretches[lane];
  }

 protected:
  void draw() override;
  bool wantsLegend() const override { return false; }

 private:
  class Lanes;
  void paintLanes(QPainter& painter) const;
  void fitHeight();
  int laneAt(double y) const;

  Lanes* m_lanes;
  TimeGestures* m_gestures;
  std::vector<std::vector<LaneStretch>> m_stretches, m_comparedStretches;
};

}  // namespace pitchboard::ui
