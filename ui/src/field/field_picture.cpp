// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_picture.h"

#include <QPainter>
#include <algorithm>

#include "field_background.h"

namespace pitchboard::ui {

QImage paintPicture(FieldScene& scene, QSize size) {
  QImage image(size, QImage::Format_RGB32);
  const FieldStyle before = scene.style();
  const sim::FieldSpec& field = before.field;
  const double scale = std::min(size.width() / (field.length + 2 * field.border),
                                size.height() / (field.width + 2 * field.border));
  const double sign = before.flipped ? -1.0 : 1.0;
  QTransform toPicture = QTransform::fromTranslate(size.width() / 2.0, size.height() / 2.0);
  toPicture.scale(sign * scale, -sign * scale);
  scene.changeStyle([&](FieldStyle& style) {
    style.pixelsPerMetre = scale;
    style.ornaments = false;
  });
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  paintFieldBackground(painter, scene.style(), toPicture, QRectF(QPointF(), QSizeF(size)));
  // QGraphicsScene::render() knows no mirrored target, so the source is mirrored by the painter.
  painter.setTransform(toPicture);
  const QRectF source = toPicture.inverted().mapRect(QRectF(QPointF(), QSizeF(size)));
  scene.render(&painter, source, source, Qt::IgnoreAspectRatio);
  scene.changeStyle([&](FieldStyle& style) {
    style.pixelsPerMetre = before.pixelsPerMetre;
    style.ornaments = before.ornaments;
  });
  return image;
}

}  // namespace pitchboard::ui
