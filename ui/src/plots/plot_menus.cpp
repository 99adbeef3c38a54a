// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_menus.h"

#include <QMenu>

#include "plot_page.h"
#include "plots_dock.h"

namespace pitchboard::ui {

QMenu* makePlotsMenu(PlotsDock* dock) { return new QMenu(dock); }
void showPlotMenu(PlotsDock*, PlotPage*, PlotPane*, int, const QPoint&) {}
void askForCurve(PlotsDock*) {}
void editCurve(PlotsDock*, PlotPane*, int) {}

}  // namespace pitchboard::ui
