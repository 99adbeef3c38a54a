// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plots as pictures, tables and text. UI thread only.

#include <QImage>
#include <QString>

#include <base/result.h>
#include <telemetry/series/series_store.h>

class QIODevice;

namespace pitchboard::ui {

class PlotPage;
class PlotPane;

/// The plots of a page as on the screen, in `ratio` pixels for one of theirs.
QImage plotPicture(PlotPage& page, double ratio);
/// PNG with twice the pixels of the screen; SVG with lines, and text in fonts that every browser
/// has.
Result<void> savePlotPng(PlotPage& page, const QString& path);
Result<void> savePlotSvg(PlotPage& page, const QString& path);
/// Every sample in the range: a first line of names, then time in s and one column for each curve;
/// a cell is empty where a curve has no sample at that time. RFC 4180, decimal point.
Result<void> savePlotCsv(const QList<PlotPane*>& panes, telemetry::TimeRange range,
                         const QString& path);
void writeCsv(QIODevice& device, const QList<PlotPane*>& panes, telemetry::TimeRange range);
/// Name, value and unit of every curve at a time (the newest without one), a line each, with tabs.
QString valuesText(const QList<PlotPane*>& panes, std::optional<double> time);

}  // namespace pitchboard::ui
