// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_stamps.h"

#include <QCache>
#include <QPaintEngine>
#include <QPixmap>
#include <algorithm>
#include <cmath>

namespace pitchboard::ui {
namespace {

constexpr double largestReach = 128.0;                       // pixels
constexpr qsizetype maxPixels = qsizetype{4} * 1024 * 1024;  // 16 MB
constexpr int phases = 4;                                    // of a pixel, each way

/// A wide thin disc is taken to whole pixels: it changes its size all the time, and with as many
/// phases as a number none would be found again.
int phasesOf(const Stamp& stamp) {
  return stamp.kind == Stamp::Kind::Belief ? 1 : phases;
}

struct Key {
  Stamp stamp;
  int phaseX = 0, phaseY = 0;
  int ratio = 0;  // of device pixels, in hundredths
  bool operator==(const Key&) const = default;
};

size_t qHash(const Key& key, size_t seed = 0) {
  const Stamp& stamp = key.stamp;
  return qHashMulti(seed, static_cast<int>(stamp.kind), stamp.size, stamp.color, stamp.second,
                    stamp.text, key.phaseX, key.phaseY, key.ratio);
}

struct Placed {
  QPixmap pixmap;
  QPointF origin;  // in the pixmap, device-independent pixels
};

QCache<Key, Placed>& cache() {
  static QCache<Key, Placed> stamps(maxPixels);
  return stamps;
}

Placed paintStamp(const Key& key, double ratio, const QSizeF& reach,
                  const std::function<void(QPainter&)>& paint) {
  // Whole device pixels, one of them for the phase.
  const int left = static_cast<int>(std::ceil(reach.width() * ratio)) + 1;
  const int top = static_cast<int>(std::ceil(reach.height() * ratio)) + 1;
  Placed placed{QPixmap(2 * left + 1, 2 * top + 1), QPointF(left, top) / ratio};
  placed.pixmap.setDevicePixelRatio(ratio);
  placed.pixmap.fill(Qt::transparent);
  QPainter painter(&placed.pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(placed.origin +
                    QPointF(key.phaseX, key.phaseY) / (phasesOf(key.stamp) * ratio));
  paint(painter);
  return placed;
}

}  // namespace

void drawStamp(QPainter* painter, const QPointF& centre, const Stamp& stamp, const QSizeF& reach,
               const std::function<void(QPainter&)>& paint) {
  const QTransform before = painter->worldTransform();
  const QPointF at = before.map(centre);
  // Pictures for files keep shapes as shapes.
  const bool shapes = painter->paintEngine()->type() == QPaintEngine::SVG;
  if (shapes || std::max(reach.width(), reach.height()) > largestReach) {
    painter->setWorldTransform(QTransform::fromTranslate(at.x(), at.y()));
    paint(*painter);
    painter->setWorldTransform(before);
    return;
  }
  const double ratio = painter->device()->devicePixelRatioF();
  const int steps = phasesOf(stamp);
  const double x = std::round(at.x() * ratio * steps);
  const double y = std::round(at.y() * ratio * steps);
  const QPointF whole(std::floor(x / steps), std::floor(y / steps));
  const Key key{stamp, static_cast<int>(x - whole.x() * steps),
                static_cast<int>(y - whole.y() * steps),
                static_cast<int>(std::lround(ratio * 100))};
  const Placed* placed = cache().object(key);
  Placed fresh;
  if (!placed) {
    fresh = paintStamp(key, ratio, reach, paint);
    placed = &fresh;
    const qsizetype pixels = qsizetype(fresh.pixmap.width()) * fresh.pixmap.height();
    cache().insert(key, new Placed(fresh), pixels);
  }
  painter->setWorldTransform(QTransform());
  painter->drawPixmap(whole / ratio - placed->origin, placed->pixmap);
  painter->setWorldTransform(before);
}

}  // namespace pitchboard::ui
