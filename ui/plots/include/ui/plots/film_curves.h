// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plots for an exported video. UI thread only.

#include <QSize>

#include <ui/sources/film_parts.h>

namespace pitchboard::ui {

class PlotsDock;

/// Returns the current tab as it is shown, with at least this many pixels across; null without
/// plots.
FilmCurves filmCurves(const PlotsDock& plots, int width);

}  // namespace pitchboard::ui
