// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_picture.h"

#include <QBuffer>
#include <QPainter>
#include <QSvgGenerator>
#include <algorithm>

#include "field_background.h"

namespace pitchboard::ui {

namespace {

void paintField(FieldScene& scene, QPainter& painter, QSize size) {
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
}

}  // namespace

QImage paintPicture(FieldScene& scene, QSize size) {
  QImage image(size, QImage::Format_RGB32);
  QPainter painter(&image);
  paintField(scene, painter, size);
  return image;
}

QByteArray svgPicture(FieldScene& scene, QSize size) {
  QByteArray text;
  QBuffer buffer(&text);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(size);
  generator.setViewBox(QRect(QPoint(), size));
  generator.setTitle(QStringLiteral("The field"));
  QPainter painter;
  if (!painter.begin(&generator)) return {};
  paintField(scene, painter, size);
  painter.end();
  return text;
}

}  // namespace pitchboard::ui
