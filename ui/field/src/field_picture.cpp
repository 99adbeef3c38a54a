// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_picture.h"

#include <QBuffer>
#include <QPainter>
#include <QSvgGenerator>
#include <algorithm>

#include <ui/base/robot_text.h>
#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>
#include <ui/sources/note_painting.h>

#include "field_background.h"

namespace pitchboard::ui {

namespace {

void paintField(FieldScene& scene, QPainter& painter, QSize size,
                std::span<const telemetry::DrawnNote> notes) {
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
  if (!scene.frame()) return;
  painter.resetTransform();
  paintFieldNotes(painter, notes, toPicture, scene.frame()->snapshot.time);
  const int high = std::max(static_cast<int>(field.border * scale * 0.4), 11);
  const double top = (size.height() - (field.width + 2 * field.border) * scale) / 2;
  const QFont font = fieldFont(high, true);
  drawHaloText(&painter, {size.width() / 2.0, top + field.border * scale / 2},
               pictureCaption(*scene.frame(), QFontMetricsF(font), size.width() - 2.0 * high), font,
               theme().fieldLines, theme().fieldBorder.darker(150));
}

}  // namespace

QString pictureCaption(const link::MatchFrame& frame, const QFontMetricsF& metrics, double width) {
  link::MatchFrame playing = frame;
  playing.paused = false;  // a picture in a file does not say that the match is paused
  const ScoreboardState board = scoreboardOf(playing);
  if (board.leftName.isEmpty()) return clockText(frame.snapshot.time);
  const QString score = QStringLiteral("%1  %2 : %3  %4")
                            .arg(board.leftName)
                            .arg(board.left)
                            .arg(board.right)
                            .arg(board.rightName);
  QString text;
  for (const QString& penalties : {board.penalties, QString()}) {
    for (const QString& state : QStringList(board.state) + board.shorter) {
      QStringList parts{score, board.clock, board.period, state, penalties};
      parts.removeAll(QString());
      text = parts.join(QStringLiteral("    "));
      if (metrics.horizontalAdvance(text) <= width) return text;
    }
  }
  return text;
}

QSize pictureSize(const sim::FieldSpec& field, QSize within) {
  const QSizeF shape(field.length + 2 * field.border, field.width + 2 * field.border);
  const QSize size = shape.scaled(within, Qt::KeepAspectRatio).toSize();
  return {std::max(size.width() & ~1, 2), std::max(size.height() & ~1, 2)};
}

QImage paintPicture(FieldScene& scene, QSize size, std::span<const telemetry::DrawnNote> notes) {
  QImage image(size, QImage::Format_RGB32);
  QPainter painter(&image);
  paintField(scene, painter, size, notes);
  return image;
}

QByteArray svgPicture(FieldScene& scene, QSize size, std::span<const telemetry::DrawnNote> notes) {
  QByteArray text;
  QBuffer buffer(&text);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(size);
  generator.setViewBox(QRect(QPoint(), size));
  generator.setTitle(QStringLiteral("The field"));
  QPainter painter;
  if (!painter.begin(&generator)) return {};
  paintField(scene, painter, size, notes);
  painter.end();
  return text;
}

FilmPainter::FilmPainter(const FieldStyle& style, std::vector<telemetry::DrawnNote> notes)
    : m_notes(std::move(notes)) {
  m_scene.changeStyle([&style](FieldStyle& own) {
    own.layers = style.layers;
    own.drawings = style.drawings;
    own.drawings.onlySelected = false;  // nothing is selected in a film
    own.flipped = style.flipped;
    own.wedgeForAll = style.wedgeForAll;
    own.eopraGranularity = style.eopraGranularity;
    own.readOnly = true;
  });
}

QImage FilmPainter::paint(const FramePtr& frame, QSize size) {
  m_scene.showFrame(frame);
  return paintPicture(m_scene, size, m_notes);
}

}  // namespace pitchboard::ui
