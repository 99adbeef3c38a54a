// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where field, cameras and plots are in an exported video, and painting them there: the field on
// the left, cameras on the right, plots below. Pixels. UI thread only; pure functions.

#include <QRect>
#include <vector>

#include <ui/sources/film_parts.h>

namespace pitchboard::ui {

struct FilmLayout {
  QRect field, curves;  ///< curves: empty without plots
  std::vector<QRect> cameras;
};
FilmLayout filmLayout(QSize size, std::size_t cameras, bool hasCurves);

/// Returns the largest rectangle in the middle of `room` with the proportions of a picture.
QRectF fitted(QSizeF picture, const QRectF& room);

/// Paints a moment of the film. `cameras` are the pictures of `parts.cameras`; null: none.
QImage paintFilm(QSize size, const FilmParts& parts, const QImage& field,
                 const std::vector<QImage>& cameras, const link::MatchFrame& frame, double time);

}  // namespace pitchboard::ui
