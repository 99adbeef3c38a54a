// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the plots show, without any data: tabs, plots, curves. Plain values; they are what a preset
// holds. Variables are named `GROUP/COLUMN`, so a layout fits every source that has such names.
// In place of a group, `each` stands for every group that has the columns, and `first` for the
// first one; `curve/NAME` is another computed curve of the plots.

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
  Variable,       ///< inputs: the variable
  Derivative,     ///< d/dt of the input, per second
  Integral,       ///< over time, from the first sample kept
  MovingAverage,  ///< `parameter`: window in s
  Difference,     ///< first input minus second
  WrapAngle,   ///< into (−parameter/2, parameter/2]; parameter: a full turn in the input's unit
  Conversion,  ///< input × parameter + offset, shown in `unit`
  Expression   ///< `expression` over variables
};

enum class CurveStyle { Line, Steps, Points, LineAndPoints };

struct CurveSpec {
  enum class Side {
    ByUnit,  ///< with the curves whose unit it has, or can be converted to
    Left,
    Right
  };
  CurveKind kind = CurveKind::Variable;
  QStringList inputs;
  QString expression;
  double parameter = 0.0;
  double offset = 0.0;
  QString unit;         ///< instead of the variable's; empty: the variable's
  QString title;        ///< instead of its name; empty: the name
  int colorNumber = 0;  ///< of the palette of curves, which has one for each theme
  QColor color;         ///< chosen by hand; not valid: the palette's
  CurveStyle style = CurveStyle::Line;
  double width = 1.5;        ///< px of the mock
  Side side = Side::ByUnit;  ///< the value axis that it is read at
  QStringList hidden;        ///< names of the shown curves (curveName) that are not drawn
  bool operator==(const CurveSpec&) const = default;
};

enum class PaneKind {
  Chart,  ///< curves over time
  Lane,   ///< codes and flags in words over time
  Xy      ///< each curve: its second input over its first
};

struct PaneSpec {
  PaneKind kind = PaneKind::Chart;
  QString title;
  QString valueTitle;        ///< beside the value axis
  bool autoValues = true;    ///< limits follow what is visible
  ValueLimits values;        ///< when not automatic
  bool equalScales = false;  ///< Xy: a metre is a metre in both directions
  QList<CurveSpec> curves;
  int share = 100;  ///< of the height, relative to the other plots
  // Chart: of the second value axis.
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
/// Refuses what is not a layout, with line and key in `source`; unknown members are ignored so that
/// layouts of later versions can be read.
Result<PlotLayout> layoutFromText(std::string_view text, std::string_view source);

/// "VISION_BALL_DIST B1", "d/dt VISION_BALL_DIST B1", or the title.
QString curveName(const CurveSpec& curve);
/// Computed from the same things in the same way, whatever it looks like.
bool sameData(const CurveSpec& a, const CurveSpec& b);
/// A variable on its own.
CurveSpec variableCurve(const QString& name);

}  // namespace pitchboard::ui
