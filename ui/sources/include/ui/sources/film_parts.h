// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What can be shown beside the field in an exported video: the cameras of a session and its plots.
// The panels that have them make these values, so that exporting does not depend on the panels.

#include <QImage>
#include <QRectF>
#include <functional>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <ui/base/time_axis.h>

class QPainter;

namespace pitchboard::ui {

struct FilmCamera {
  /// Returns the picture at a time (s of the session) that fits into `within` pixels; null if there
  /// is none, or if `goesOn` returned false. Called on a worker thread, one call at a time.
  std::function<QImage(double time, QSize within, const std::function<bool()>& goesOn)> picture;
  /// Draws the field over the picture, which fills this rectangle. UI thread.
  std::function<void(QPainter& painter, const QRectF& rect, const link::MatchFrame& frame)> overlay;
};

/// Plots as they are shown; a line moves through them.
struct FilmCurves {
  QImage picture;   ///< null: no plots
  TimeAxis axis{};  ///< in its pixels
};

struct FilmParts {
  std::vector<FilmCamera> cameras = {};
  FilmCurves curves = {};
  bool isEmpty() const { return cameras.empty() && curves.picture.isNull(); }
};

}  // namespace pitchboard::ui
