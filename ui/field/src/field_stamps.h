// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small pictures that are painted once and then only copied: discs with numbers, circles of belief,
// ghosts, texts. Keyed by all that they depend on; the least used ones go. UI thread only.

#include <QColor>
#include <QPainter>
#include <QPointF>
#include <QSizeF>
#include <QString>
#include <cmath>
#include <functional>

namespace pitchboard::ui {

/// What a stamp looks like: equal ones are the same picture.
struct Stamp {
  enum class Kind { Belief, Ghost, Disc, Ball, PerceivedBall, Ring, Text, BoldText, Plate };
  Kind kind = Kind::Disc;
  int size = 0;  ///< in a unit that depends on the kind
  QRgb color = 0;
  QRgb second = 0;  ///< of the outline or halo
  QString text;
  bool operator==(const Stamp&) const = default;
};

/// A length in pixels as the `size` of a stamp.
inline int stampSize(double pixels) {
  return static_cast<int>(std::lround(pixels * 16));
}

/// Puts the stamp down with its origin at `centre`, to a quarter of a device pixel. The painter's
/// transform must be a translation. `reach`: how far the picture goes each way from its origin, in
/// pixels. `paint` draws it round (0, 0) when it is not known yet, or when it is too large to keep.
void drawStamp(QPainter* painter, const QPointF& centre, const Stamp& stamp, const QSizeF& reach,
               const std::function<void(QPainter&)>& paint);

}  // namespace pitchboard::ui
