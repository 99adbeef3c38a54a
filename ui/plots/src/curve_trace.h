// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is drawn of a curve: its samples where they are few, else the least and greatest value of
// each pixel column. So a drawing costs what the screen can show and not what there is.

#include <QPolygonF>
#include <vector>

#include <telemetry/series/series_summary.h>
#include <ui/base/time_axis.h>
#include <ui/plots/plot_layout.h>

#include "plot_feed.h"

class QPainter;
class QPen;

namespace pitchboard::ui {

/// Where values stand in a widget; y grows downwards.
struct ValueScale {
  ValueLimits limits;
  double top = 0.0;
  double bottom = 1.0;
  double toY(double value) const {
    return bottom - (value - limits.low) / (limits.high - limits.low) * (bottom - top);
  }
  double toValue(double y) const {
    return limits.low + (bottom - y) / (bottom - top) * (limits.high - limits.low);
  }
};

/// A curve is not drawn across a longer silence than this; it is the time after which a robot
/// counts as timed out.
inline constexpr double maxBridge = telemetry::SummaryPart::maxSilence;  // s

struct CurveTrace {
  /// One per pixel column; times are the columns' middles.
  struct Column {
    double time, first, min, max, last;
  };
  bool exact = true;         ///< `samples` are all there are; else `columns`
  double columnWidth = 0.0;  ///< s; 0 for samples
  /// The rows of this range are not in memory: `columns` are an envelope of many rows each.
  bool coarse = false;
  bool reading = false;  ///< and they are on their way
  /// Samples come about once a second or less often: each is a dot, and holds until the next one.
  bool held = false;
  double heldUntil = 0.0;                  ///< the last one of them (s)
  std::vector<telemetry::Sample> samples;  ///< NaN breaks the line
  std::vector<Column> columns;             ///< NaN in min breaks the line
  bool any = false;                        ///< low and high hold
  double low = 0.0, high = 0.0;            ///< of what is visible

  bool operator==(const CurveTrace&) const = delete;
};

/// `columns`: device pixels of the range. Includes the neighbours outside, so that lines run on to
/// the edges. `now`: up to here the newest sample holds.
CurveTrace traceOf(const ColumnView& view, telemetry::TimeRange range, int columns,
                   double now = -1e300);

/// The line in pixels, one polygon for each unbroken stretch; of an envelope its outline. In steps
/// and where values hold, every other point is a sample, the first one included.
std::vector<QPolygonF> polylines(const CurveTrace& trace, const TimeAxis& time,
                                 const ValueScale& values, bool steps);

struct TraceLook {
  QColor color;
  CurveStyle style = CurveStyle::Line;
  double width = 1.5;  ///< px
  /// So many points that wide lines would take too long: they are one pixel wide.
  bool thin = false;
  double pixel = 1.0;  ///< of the mock
  int dash = 0;        ///< of curveDash()
};
/// Points of all curves of a plot from which lines are thin.
inline constexpr std::size_t manyPoints = 2500;
/// `lines`: polylines() of the trace. Only what lies in the painter's clip is painted, so parts of
/// one picture can be painted side by side. `time` is for the distance of dots. Any thread.
void paintTrace(QPainter& painter, const CurveTrace& trace, const std::vector<QPolygonF>& lines,
                const TimeAxis& time, const TraceLook& look);

}  // namespace pitchboard::ui
