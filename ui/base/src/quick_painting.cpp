// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/quick_painting.h>

#include <QCache>
#include <QFontMetricsF>
#include <QPaintEngine>
#include <QPixmap>
#include <QStaticText>
#include <algorithm>
#include <cmath>

#include <ui/base/elide_text.h>

namespace pitchboard::ui {
namespace {

constexpr int maxTextLines = 4000;
constexpr int maxCorners = 200;

/// The properties in which the studio's fonts differ.
struct FontKey {
  explicit FontKey(const QFont& font)
      : family(font.family()),
        points(font.pointSizeF()),
        pixels(font.pixelSize()),
        weight(font.weight()),
        marks((font.strikeOut() ? 1 : 0) + (font.italic() ? 2 : 0) + (font.underline() ? 4 : 0)) {}
  bool operator==(const FontKey&) const = default;
  QString family;
  double points;
  int pixels, weight, marks;
};

struct TextLineKey {
  QString text;
  FontKey font;
  int room = -1;  // in which they are cut off; -1: whole
  int elide = 0;
  bool operator==(const TextLineKey&) const = default;
};

size_t qHash(const TextLineKey& key, size_t seed = 0) {
  return qHashMulti(seed, key.text, key.font.points, key.font.pixels, key.font.weight,
                    key.font.marks, key.room, key.elide);
}

struct Shaped {
  QStaticText text;
  QSizeF size;
};

const Shaped& shaped(const TextLineKey& key, const QFont& font) {
  static QCache<TextLineKey, Shaped> cache(maxTextLines);
  if (const Shaped* known = cache.object(key)) return *known;
  auto* made = new Shaped;
  const QFontMetricsF metrics(font);
  QString text = key.text;
  if (key.room >= 0) {
    text = key.elide == Qt::ElideRight
               ? elideText(metrics, text, key.room)
               : metrics.elidedText(text, static_cast<Qt::TextElideMode>(key.elide), key.room);
  }
  made->text.setTextFormat(Qt::PlainText);
  made->text.setText(text);
  made->text.prepare({}, font);
  made->size = {metrics.horizontalAdvance(text), metrics.height()};
  cache.insert(key, made);  // owns it now; one entry costs 1 and is never refused
  return *made;
}

bool onPixels(const QPainter& painter) {
  return painter.paintEngine()->type() == QPaintEngine::Raster;
}

/// A whole number of device pixels for each pixel, and nothing turned.
bool isSharp(const QPainter& painter) {
  if (!onPixels(painter)) return false;
  const QTransform& to = painter.deviceTransform();
  return to.type() <= QTransform::TxScale && to.m11() == to.m22() && to.m11() >= 1.0 &&
         to.m11() == std::floor(to.m11());
}

struct CornerKey {
  QRgb fill = 0, edge = 0;
  int radius = 0, ratio = 0;  // in hundredths; device pixels for each
  bool operator==(const CornerKey&) const = default;
};

size_t qHash(const CornerKey& key, size_t seed = 0) {
  return qHashMulti(seed, key.fill, key.edge, key.radius, key.ratio);
}

void paintBox(QPainter& painter, const QRectF& box, double radius, const QColor& fill,
              const QColor& edge) {
  painter.setBrush(fill);
  if (edge.isValid()) {
    painter.setPen(QPen(edge, 1));
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), radius, radius);
  } else {
    painter.setPen(Qt::NoPen);
    painter.drawRoundedRect(box, radius, radius);
  }
}

/// A box as small as its corners allow: `side` pixels each way for a corner.
QPixmap cornersOf(const CornerKey& key, int side, double radius, const QColor& fill,
                  const QColor& edge) {
  static QCache<CornerKey, QPixmap> cache(maxCorners);
  if (const QPixmap* known = cache.object(key)) return *known;
  QPixmap corners(2 * side * key.ratio, 2 * side * key.ratio);
  corners.setDevicePixelRatio(key.ratio);
  corners.fill(Qt::transparent);
  QPainter painter(&corners);
  painter.setRenderHint(QPainter::Antialiasing);
  paintBox(painter, QRectF(0, 0, 2 * side, 2 * side), radius, fill, edge);
  painter.end();
  cache.insert(key, new QPixmap(corners));
  return corners;
}

}  // namespace

void drawTextLine(QPainter& painter, const QRectF& box, Qt::Alignment alignment,
                  const QString& text, Qt::TextElideMode elide) {
  if (text.isEmpty()) return;
  const QFont& font = painter.font();
  TextLineKey key{text, FontKey(font)};
  const Shaped* line = &shaped(key, font);
  if (elide != Qt::ElideNone && line->size.width() > box.width()) {
    key.room = std::max(0, static_cast<int>(box.width()));
    key.elide = elide;
    line = &shaped(key, font);
  }
  if (!onPixels(painter)) {
    painter.drawText(box, static_cast<int>(alignment) | Qt::TextSingleLine, line->text.text());
    return;
  }
  QPointF at = box.topLeft();
  if (alignment & Qt::AlignRight)
    at.rx() = box.left() + box.width() - line->size.width();
  else if (alignment & Qt::AlignHCenter)
    at.rx() += (box.width() - line->size.width()) / 2;
  if (alignment & Qt::AlignBottom)
    at.ry() = box.top() + box.height() - line->size.height();
  else if (alignment & Qt::AlignVCenter)
    at.ry() += (box.height() - line->size.height()) / 2;
  painter.drawStaticText(at, line->text);
}

double textLineWidth(const QFont& font, const QString& text) {
  return text.isEmpty() ? 0.0 : shaped({text, FontKey(font)}, font).size.width();
}

void drawRoundBox(QPainter& painter, const QRectF& box, double radius, const QColor& fill,
                  const QColor& edge) {
  const int side = static_cast<int>(std::ceil(radius)) + 1;
  const QRect whole =
      QRect(QPoint(qRound(box.left()), qRound(box.top())),
            QPoint(qRound(box.left() + box.width()) - 1, qRound(box.top() + box.height()) - 1));
  if (!isSharp(painter) || whole.width() < 2 * side || whole.height() < 2 * side) {
    const bool smooth = painter.testRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::Antialiasing);
    paintBox(painter, box, radius, fill, edge);
    painter.setRenderHint(QPainter::Antialiasing, smooth);
    return;
  }
  const int ratio = static_cast<int>(painter.deviceTransform().m11());
  const QPixmap corners =
      cornersOf({fill.rgba(), edge.isValid() ? edge.rgba() : 0, qRound(radius * 100), ratio}, side,
                radius, fill, edge);
  const int x0 = whole.left(), x1 = whole.right() + 1, y0 = whole.top(), y1 = whole.bottom() + 1;
  const int part = side * ratio;
  for (const int right : {0, 1}) {
    for (const int low : {0, 1}) {
      painter.drawPixmap(QPoint(right ? x1 - side : x0, low ? y1 - side : y0), corners,
                         QRect(right * part, low * part, part, part));
    }
  }
  const int wide = x1 - x0 - 2 * side, high = y1 - y0 - 2 * side, line = edge.isValid() ? 1 : 0;
  if (line) {
    painter.fillRect(x0 + side, y0, wide, 1, edge);
    painter.fillRect(x0 + side, y1 - 1, wide, 1, edge);
    painter.fillRect(x0, y0 + side, 1, high, edge);
    painter.fillRect(x1 - 1, y0 + side, 1, high, edge);
  }
  painter.fillRect(x0 + side, y0 + line, wide, side - line, fill);
  painter.fillRect(x0 + side, y1 - side, wide, side - line, fill);
  painter.fillRect(x0 + line, y0 + side, x1 - x0 - 2 * line, high, fill);
}

}  // namespace pitchboard::ui
