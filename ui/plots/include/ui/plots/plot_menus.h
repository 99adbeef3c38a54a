// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menus and dialogs of the plots. UI thread only.

#include <QPoint>

class QMenu;

namespace pitchboard::ui {

class PlotPage;
class PlotPane;
class PlotsDock;

/// Makes the menu of the tool row: tabs, named layouts, export. Owned by the dock.
QMenu* makePlotsMenu(PlotsDock* dock);
/// Shows the context menu of a plot, or of one of its curves if `curve` ≥ 0.
void showPlotMenu(PlotsDock* dock, PlotPage* page, PlotPane* pane, int curve, const QPoint& at);
/// Opens the dialog for a new curve on the current page.
void askForCurve(PlotsDock* dock);
void editCurve(PlotsDock* dock, PlotPane* pane, int curve);

}  // namespace pitchboard::ui
