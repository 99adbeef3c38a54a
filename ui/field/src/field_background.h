// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Grass, border, lines, goals and the coordinate grid. They change only with zoom, size, theme or
// layers, so the view keeps them as a pixmap.

#include <QPixmap>
#include <QTransform>
#include <vector>

#include "field_style.h"

namespace pitchboard::ui {

/// Paints all of it into `area` (pixels of the painter); `sceneToView` maps metres to pixels.
void paintFieldBackground(QPainter& painter, const FieldStyle& style, const QTransform& sceneToView,
                          const QRectF& area);

/// A number at a line of the coordinate grid, in pixels; metres.
struct GridLabel {
  QRectF box;
  QString text;
};
/// Returns the numbers of the lines that are seen, all of them whole and inside `area`.
std::vector<GridLabel> gridLabels(const FieldStyle& style, const QTransform& sceneToView,
                                  const QRectF& area);

/// The pixmap of it for one view; painted again when anything it depends on has changed.
class FieldBackground {
 public:
  /// Valid until the next call. `size` in device-independent pixels.
  const QPixmap& pixmap(const FieldStyle& style, const QTransform& sceneToView, QSize size,
                        double devicePixelRatio);
  void invalidate() { m_pixmap = QPixmap(); }

 private:
  QPixmap m_pixmap;
  QTransform m_transform;
  QSize m_size;
  double m_ratio = 0.0;
  std::array<bool, fieldLayerCount> m_layers{};
  sim::FieldSpec m_field;
};

}  // namespace pitchboard::ui
