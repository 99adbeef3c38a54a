// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Descriptions that stand for a curve of every robot (`each/NAME`, or `each.NAME` in an expression)
// or of the first robot that moves (`first`, PlotFeed::firstGroup()), so that a layout works with
// any number of robots. Plain values.

#include <QStringList>

#include <ui/plots/plot_layout.h>

#include "plot_feed.h"

namespace pitchboard::ui {

/// Returns whether the curve contains `each` or `first`.
bool isTemplate(const CurveSpec& curve);
/// Returns the curves that a description stands for in this source, named after their groups and in
/// successive colours. Returns the description itself if it is a plain curve or if no group has the
/// columns.
QList<CurveSpec> curvesOf(const CurveSpec& curve, PlotFeed& feed);
/// Returns the layout after groups of the source were renamed at the same time. Curves, computed
/// curves and expressions keep their robots.
PlotLayout renamedGroups(const PlotLayout& layout, const GroupNames& groups);
/// Turns a curve whose inputs are all of one group into a description for every group; other curves
/// are returned unchanged.
CurveSpec forEachGroup(const CurveSpec& curve);

}  // namespace pitchboard::ui
