// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_layout.h"

#include <QPainter>

#include <ui/base/theme.h>

namespace pitchboard::ui {

FilmLayout filmLayout(QSize size, std::size_t cameras, bool hasCurves) {
  constexpr double shareOfCurves = 0.3, shareOfField = 0.45;
  FilmLayout layout;
  const int bottom = hasCurves ? qRound(size.height() * (1.0 - shareOfCurves)) : size.height();
  if (hasCurves) layout.curves = QRect(0, bottom, size.width(), size.height() - bottom);
  const int middle = cameras > 0 ? qRound(size.width() * shareOfField) : size.width();
  layout.field = QRect(0, 0, middle, bottom);
  const int count = static_cast<int>(cameras), columns = count > 2 ? 2 : 1;
  const int rows = (count + columns - 1) / columns, across = size.width() - middle;
  for (int i = 0; i < count; ++i) {
    const int left = middle + across * (i % columns) / columns, top = bottom * (i / columns) / rows;
    layout.cameras.emplace_back(left, top, middle + across * (i % columns + 1) / columns - left,
                                bottom * (i / columns + 1) / rows - top);
  }
  return layout;
}

QRectF fitted(QSizeF picture, const QRectF& room) {
  QRectF rect(QPointF(), picture.scaled(room.size(), Qt::KeepAspectRatio));
  rect.moveCenter(room.center());
  return rect;
}

QImage paintFilm(QSize size, const FilmParts& parts, const QImage& field,
                 const std::vector<QImage>& cameras, const link::MatchFrame& frame, double time) {
  const FilmLayout layout = filmLayout(size, parts.cameras.size(), !parts.curves.picture.isNull());
  QImage image(size, QImage::Format_RGB32);
  image.fill(Qt::black);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(fitted(field.size(), layout.field), field);
  for (std::size_t i = 0; i < cameras.size() && i < layout.cameras.size(); ++i) {
    if (cameras[i].isNull()) continue;
    const QRectF rect = fitted(cameras[i].size(), layout.cameras[i]);
    painter.drawImage(rect, cameras[i]);
    if (parts.cameras[i].overlay) parts.cameras[i].overlay(painter, rect, frame);
  }
  if (layout.curves.isEmpty()) return image;
  const FilmCurves& curves = parts.curves;
  painter.fillRect(layout.curves, theme().view);
  const QRectF rect = fitted(curves.picture.size(), layout.curves);
  painter.drawImage(rect, curves.picture);
  if (time < curves.axis.shown.begin || time > curves.axis.shown.end) return image;
  const double x = rect.left() + curves.axis.pixel(time) * rect.width() / curves.picture.width();
  painter.setPen(QPen(theme().accentLine, 2.0));
  painter.drawLine(QPointF(x, rect.top()), QPointF(x, rect.bottom()));
  return image;
}

}  // namespace pitchboard::ui
