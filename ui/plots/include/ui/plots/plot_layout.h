// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A layout of the plots without data: tabs, plots and curves, as saved by name. Variables are named
// `GROUP/COLUMN`, so that a layout fits every source with such names. As a group, `each` stands for
// every group that has the columns, and `first` for the first one; `curve/NAME` is another computed
// curve. Plain values; any thread.

#include <QColor>
#include <QJsonObject>
#include <QList>
#include <QString>
#include <QStringList>
#include <string_view>

#include <base/result.h>
#include <ui/plots/axis_ticks.h>

namespace pitchboard::ui {

enum class CurveKind {
  Variable,       ///< its input
  Derivative,     ///< d/dt of the input, per second
  Integral,       ///< over time, from the first sample in memory
  MovingAverage,  ///< `parameter`: window in s
  Difference,     ///< first input minus second
  WrapAngle,   ///< into (−parameter/2, parameter/2]; parameter: a full turn in the input's unit
  Conversion,  ///< input × parameter + offset, shown in `unit`
  Expression   ///< `expression` over variables
};

enum class CurveStyle { Line, Steps, Points, LineAndPoints };

struct CurveSpec {
  enum class Side {
    ByUnit,  ///< the axis whose curves have the same or a convertible unit
    Left,
    Right
  };
  CurveKind kind = CurveKind::Variable;
  QStringList inputs;
  QString expression;
  double parameter = 0.0;
  double offset = 0.0;
  QString unit;         ///< empty: the variable's unit
  QString title;        ///< empty: the name
  int colorNumber = 0;  ///< index in the palette of curves
  QColor color;         ///< chosen by the user; invalid: that of the palette
  CurveStyle style = CurveStyle::Line;
  double width = 1.5;        ///< pixels of the design, see scaled()
  Side side = Side::ByUnit;  ///< the value axis
  QStringList hidden;        ///< names (curveName) of curves that are not drawn
  bool operator==(const CurveSpec&) const = default;
};

enum class PaneKind {
  Chart,  ///< curves over time
  Lane,   ///< texts of codes and flags over time
  Xy      ///< for each curve, the second input over the first
};

struct PaneSpec {
  PaneKind kind = PaneKind::Chart;
  QString title;
  QString valueTitle;        ///< title of the value axis
  bool autoValues = true;    ///< limits follow the visible values
  ValueLimits values;        ///< used if not automatic
  bool equalScales = false;  ///< Xy: both axes have the same scale
  QList<CurveSpec> curves;
  int share = 100;  ///< height relative to the other plots
  // Chart: the second value axis.
  QString rightTitle;
  bool autoRight = true;
  ValueLimits right;
  bool operator==(const PaneSpec&) const = default;
};

struct PageSpec {
  QString name;
  QList<PaneSpec> panes;
  bool operator==(const PageSpec&) const = default;
};

struct PlotLayout {
  QList<PageSpec> pages;
  int current = 0;
  bool operator==(const PlotLayout&) const = default;
};

QJsonObject toJson(const PlotLayout& layout);
/// Errors name line and key in `source`. Unknown members are ignored, so that layouts of later
/// versions can be read.
Result<PlotLayout> layoutFromText(std::string_view text, std::string_view source);

/// Returns "VISION_BALL_DIST B1", "d/dt VISION_BALL_DIST B1", or the title.
QString curveName(const CurveSpec& curve);
/// Returns whether both have the same data, whatever they look like.
bool sameData(const CurveSpec& a, const CurveSpec& b);
/// Makes a curve of a variable.
CurveSpec variableCurve(const QString& name);

}  // namespace pitchboard::ui
