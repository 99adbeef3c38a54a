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
/// The same as the bytes of a file: PNG with twice the pixels of the screen; SVG with lines, and
/// text in fonts that every browser has. Empty on failure.
QByteArray plotPng(PlotPage& page);
QByteArray plotSvg(PlotPage& page);
/// Fails where there are no bytes, too.
Result<void> savePlotPicture(const QByteArray& bytes, const QString& path);
/// Every sample in the range: a first line of names, then time in s and one column for each curve,
/// those of compared sessions behind it, at the times at which they are drawn; a cell is empty
/// where a curve has no sample at that time. RFC 4180, decimal point.
Result<void> savePlotCsv(const QList<PlotPane*>& panes, telemetry::TimeRange range,
                         const QString& path);
void writeCsv(QIODevice& device, const QList<PlotPane*>& panes, telemetry::TimeRange range);
/// Name, value and unit of every curve at a time (the newest without one), a line each, with tabs.
QString valuesText(const QList<PlotPane*>& panes, std::optional<double> time);

}  // namespace pitchboard::ui
