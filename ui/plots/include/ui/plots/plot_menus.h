// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menus and dialogs of the plots.

#include <QPoint>

class QMenu;

namespace pitchboard::ui {

class PlotPage;
class PlotPane;
class PlotsDock;

/// Tabs, named layouts, export: the menu of the tool row. Owned by the dock.
QMenu* makePlotsMenu(PlotsDock* dock);
/// What can be done with a plot, or with one of its curves (`curve` ≥ 0).
void showPlotMenu(PlotsDock* dock, PlotPage* page, PlotPane* pane, int curve, const QPoint& at);
/// Asks for a new curve of the page in front.
void askForCurve(PlotsDock* dock);
void editCurve(PlotsDock* dock, PlotPane* pane, int curve);

}  // namespace pitchboard::ui
