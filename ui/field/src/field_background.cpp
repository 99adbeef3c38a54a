// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_background.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include <ui/base/field_ground.h>
#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

void paintGoals(QPainter& painter, const sim::FieldSpec& f, double pixel) {
  QColor net = theme().fieldLines;
  QColor ground = net;
  ground.setAlphaF(0.16F);
  net.setAlphaF(0.22F);
  QColor edge = theme().fieldLines;
  edge.setAlphaF(0.62F);
  for (const auto& goal : sim::fieldLines(f, f.lineWidth).goals) {
    const double side = goal.low.x < 0 ? -1.0 : 1.0;
    const QRectF box = rectOf(goal);
    painter.fillRect(box, ground);
    const double mesh = 0.15;
    if (mesh > 7 * pixel) {
      painter.setPen(QPen(net, pixel));
      for (double at = box.left() + mesh; at < box.right() - mesh / 3; at += mesh) {
        painter.drawLine(QPointF(at, box.top()), QPointF(at, box.bottom()));
      }
      for (double at = box.top() + mesh; at < box.bottom() - mesh / 3; at += mesh) {
        painter.drawLine(QPointF(box.left(), at), QPointF(box.right(), at));
      }
    }
    painter.setPen(QPen(edge, 1.5 * pixel));
    painter.setBrush(Qt::NoBrush);
    const double line = side * f.halfLength();
    const double back = side * (f.halfLength() + f.goalDepth) - side * pixel;
    const QPointF frame[] = {{line, -f.goalWidth / 2},
                             {back, -f.goalWidth / 2},
                             {back, f.goalWidth / 2},
                             {line, f.goalWidth / 2}};
    painter.drawPolyline(frame, 4);
    painter.setPen(QPen(theme().fieldBorder.darker(150), 1.2 * pixel));
    painter.setBrush(theme().fieldLines);
    const double radius = std::max(f.goalPostRadius, 2.5 * pixel);
    for (const double y : {-f.goalWidth / 2, f.goalWidth / 2}) {
      painter.drawEllipse(QPointF(line, y), radius, radius);
    }
  }
}

/// The four corners that landmark vision tells apart, in their colours.
void paintLandmarks(QPainter& painter, const sim::FieldSpec& f, double pixel) {
  const double x = f.halfLength();
  const double y = f.halfWidth();
  const std::pair<QPointF, QColor> corners[] = {{{-x, y}, QColor(0x3d, 0x7b, 0xd9)},
                                                {{x, y}, QColor(0xd4, 0x4a, 0x44)},
                                                {{-x, -y}, QColor(0xe0, 0xb8, 0x2e)},
                                                {{x, -y}, QColor(0x94, 0x57, 0xc4)}};
  painter.setPen(QPen(theme().fieldLines, 1.5 * pixel));
  const double radius = std::max(0.12, 6 * pixel);
  for (const auto& [corner, color] : corners) {
    painter.setBrush(color);
    painter.drawEllipse(corner, radius, radius);
  }
}

/// The lines of the grid: where they are, and which part of the field is seen.
struct Grid {
  double step = 1.0;  // m
  int decimals = 0;
  double right = 0.0, top = 0.0;  // ends of the field with its border, m
  QRectF seen;                    // px

  /// Calls `draw(m)` for every line up to a limit, on both sides of 0.
  template <class Draw>
  void each(double limit, const Draw& draw) const {
    const int last = static_cast<int>(std::floor(limit / step + 1e-9));
    for (int i = -last; i <= last; ++i) draw(i * step);
  }
};

Grid gridOf(const FieldStyle& style, const QTransform& sceneToView, const QRectF& area) {
  Grid grid;
  grid.right = style.field.halfLength() + style.field.border;
  grid.top = style.field.halfWidth() + style.field.border;
  const double perMetre = std::abs(sceneToView.m11());
  grid.step = perMetre > 320 ? 0.1 : perMetre > 140 ? 0.5 : perMetre > 24 ? 1.0 : 2.0;
  grid.decimals = grid.step < 1.0 ? 1 : 0;
  const QRectF field = sceneToView.mapRect(style.playingArea());
  grid.seen = field.intersected(area);
  return grid;
}

const QFont& gridFont() {
  return fieldFont(10, false);
}

void paintGrid(QPainter& painter, const FieldStyle& style, const QTransform& sceneToView,
               const QRectF& area) {
  const Grid grid = gridOf(style, sceneToView, area);
  const QRectF& seen = grid.seen;
  QColor line = theme().fieldLines;
  line.setAlphaF(0.22F);
  QColor axis = theme().fieldLines;
  axis.setAlphaF(0.5F);
  painter.setRenderHint(QPainter::Antialiasing, false);
  grid.each(grid.right, [&](double x) {
    const double at = std::round(sceneToView.map(QPointF(x, 0)).x());
    painter.setPen(QPen(x == 0.0 ? axis : line, 1));
    painter.drawLine(QPointF(at, seen.top()), QPointF(at, seen.bottom()));
  });
  grid.each(grid.top, [&](double y) {
    const double at = std::round(sceneToView.map(QPointF(0, y)).y());
    painter.setPen(QPen(y == 0.0 ? axis : line, 1));
    painter.drawLine(QPointF(seen.left(), at), QPointF(seen.right(), at));
  });
  for (const GridLabel& label : gridLabels(style, sceneToView, area)) {
    drawHaloText(&painter, label.box.center(), label.text, gridFont(), theme().fieldLines,
                 theme().fieldBorder);
  }
  painter.setRenderHint(QPainter::Antialiasing, true);
}

}  // namespace

std::vector<GridLabel> gridLabels(const FieldStyle& style, const QTransform& sceneToView,
                                  const QRectF& area) {
  const Grid grid = gridOf(style, sceneToView, area);
  const QRectF& seen = grid.seen;
  const QFontMetricsF metrics(gridFont());
  constexpr double halo = 2.0;  // px around the text
  std::vector<GridLabel> labels;
  const auto add = [&](const QPointF& centre, double value) {
    const QString text = fieldNumber(value, grid.decimals);
    QRectF box(0, 0, textLineWidth(gridFont(), text) + 2 * halo, metrics.ascent() + 2 * halo);
    box.moveCenter(centre);
    // Beside its line rather than cut at the edge of what is seen.
    if (box.right() > seen.right()) box.moveRight(seen.right());
    if (box.left() < seen.left()) box.moveLeft(seen.left());
    if (box.top() < seen.top()) box.moveTop(seen.top());
    if (seen.contains(box)) labels.push_back({box, text});
  };
  grid.each(grid.right, [&](double x) {
    const double at = std::round(sceneToView.map(QPointF(x, 0)).x());
    if (at >= seen.left() && at <= seen.right()) add({at, seen.bottom() - 8}, x);
  });
  grid.each(grid.top, [&](double y) {
    const double at = std::round(sceneToView.map(QPointF(0, y)).y());
    if (at >= seen.top() && at < seen.bottom() - 20) add({seen.left() + 14, at}, y);
  });
  return labels;
}

void paintFieldBackground(QPainter& painter, const FieldStyle& style, const QTransform& sceneToView,
                          const QRectF& area) {
  painter.fillRect(area, theme().window);
  const sim::FieldSpec& f = style.field;
  const double pixel = 1.0 / std::abs(sceneToView.m11());
  const double lineWidth = std::max(f.lineWidth, 1.4 * pixel);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setTransform(sceneToView, true);
  paintGround(painter, f, lineWidth);
  paintGoals(painter, f, pixel);
  if (style.shows(FieldLayer::Landmarks)) paintLandmarks(painter, f, pixel);
  painter.restore();
  if (style.shows(FieldLayer::Grid)) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    paintGrid(painter, style, sceneToView, area);
    painter.restore();
  }
}

const QPixmap& FieldBackground::pixmap(const FieldStyle& style, const QTransform& sceneToView,
                                       QSize size, double devicePixelRatio) {
  if (m_pixmap.isNull() || m_size != size || m_ratio != devicePixelRatio ||
      m_layers != style.layers || m_transform != sceneToView || !(m_field == style.field)) {
    const QSize device = size * devicePixelRatio;
    if (m_pixmap.size() != device) m_pixmap = QPixmap(device);
    m_pixmap.setDevicePixelRatio(devicePixelRatio);
    m_size = size;
    m_ratio = devicePixelRatio;
    m_layers = style.layers;
    m_transform = sceneToView;
    m_field = style.field;
    QPainter painter(&m_pixmap);
    paintFieldBackground(painter, style, sceneToView, QRectF(QPointF(0, 0), QSizeF(size)));
  }
  return m_pixmap;
}

}  // namespace pitchboard::ui
