// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Descriptions of curves that stand for one curve of every robot (`each/NAME`, `each.NAME` in an
// expression) or of the first robot that moves (`first`, PlotFeed::firstGroup()): so a layout
// survives another number of robots. Plain values.

#include <QStringList>

#include <ui/plots/plot_layout.h>

namespace pitchboard::ui {

class PlotFeed;

/// `each` or `first` stands in it.
bool isTemplate(const CurveSpec& curve);
/// The curves that it stands for in this source, each named after its group, in the colours that
/// follow its own; itself while no group has the columns, and for a plain curve.
QList<CurveSpec> curvesOf(const CurveSpec& curve, PlotFeed& feed);
/// The same curve for every group: of a curve with inputs of one group only, else nothing changes.
CurveSpec forEachGroup(const CurveSpec& curve);

}  // namespace pitchboard::ui
