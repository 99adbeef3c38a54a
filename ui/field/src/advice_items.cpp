// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice_items.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double strongest = 0.85;  // opacity of the strongest cell
constexpr double tip_px = 10.0, ring_px = 17.0, textRoom_px = 220.0;

}  // namespace

void HeatItem::setHeat(std::shared_ptr<const link::BallHeat> heat, const QColor& color) {
  if (heat == m_heat && color == m_color) return;
  prepareGeometryChange();
  m_heat = std::move(heat);
  m_color = color;
  m_picture = {};
  if (m_heat && m_heat->columns > 0 && m_heat->rows > 0 &&
      std::ssize(m_heat->cells) == std::ptrdiff_t{m_heat->columns} * m_heat->rows) {
    const float most = *std::ranges::max_element(m_heat->cells);
    m_picture = QImage(m_heat->columns, m_heat->rows, QImage::Format_ARGB32);
    auto next = m_heat->cells.begin();  // row by row
    for (int y = 0; y < m_heat->rows; ++y) {
      for (int x = 0; x < m_heat->columns; ++x) {
        const float share = *next++;
        QColor cell = m_color;
        // By the root: a ball that scatters widely shows as well.
        cell.setAlphaF(most > 0.0F ? static_cast<float>(strongest) * std::sqrt(share / most)
                                   : 0.0F);
        m_picture.setPixelColor(x, y, cell);
      }
    }
  }
  update();
}

QRectF HeatItem::boundingRect() const {
  const sim::FieldSpec& field = m_style->field;
  return {-field.halfLength(), -field.halfWidth(), field.length, field.width};
}

void HeatItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (m_picture.isNull()) return;
  const QPainter::RenderHints before = painter->renderHints();
  painter->setRenderHint(QPainter::SmoothPixmapTransform);
  // The first row is the lowest, and so is the smallest y.
  painter->drawImage(boundingRect(), m_picture);
  painter->setRenderHints(before);
}

void ActionArrowsItem::setActions(std::vector<DrawnAction> actions) {
  if (actions == m_actions) return;
  prepareGeometryChange();
  m_actions = std::move(actions);
  update();
}

QRectF ActionArrowsItem::boundingRect() const {
  QRectF all;
  for (const DrawnAction& action : m_actions) {
    const QPointF to = action.to.value_or(action.from);
    const double margin = m_style->metres(textRoom_px);
    all |= QRectF(action.from, to).normalized().adjusted(-margin, -margin, margin, margin);
  }
  return all;
}

void ActionArrowsItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  for (const DrawnAction& action : m_actions) {
    const QPointF end = action.to.value_or(action.from);
    const ScreenPainting screen(painter, end);
    const QPointF start = screen.pixels(action.from - end);
    const double length = std::hypot(start.x(), start.y());
    const bool isArrow = action.to && length > tip_px;
    const QPointF along = isArrow ? -start / length : QPointF(0, 1);
    const QPointF side(-along.y(), along.x());
    painter->setOpacity(action.opacity);
    const auto stroke = [&](const QColor& color, double width) {
      QPen pen(color, width);
      pen.setCapStyle(Qt::RoundCap);
      pen.setJoinStyle(Qt::RoundJoin);
      if (action.dashed) pen.setDashPattern({3.0, 2.5});
      painter->setPen(pen);
      painter->setBrush(Qt::NoBrush);
      if (!isArrow) {
        painter->drawEllipse(QPointF(0, 0), ring_px, ring_px);
        return;
      }
      painter->drawLine(start, -along * action.width);
      pen.setStyle(Qt::SolidLine);
      painter->setPen(pen);
      painter->drawLine(QPointF(0, 0), -along * tip_px + side * 0.6 * tip_px);
      painter->drawLine(QPointF(0, 0), -along * tip_px - side * 0.6 * tip_px);
    };
    stroke(theme().window, action.width + 2.5);  // a rim, so that it reads on lines and robots
    stroke(action.color, action.width);
    if (!action.text.isEmpty()) {
      const double above = isArrow && along.y() > 0.2 ? 1.0 : -1.0;
      const double away = isArrow ? 14.0 : ring_px + 12.0;
      drawPlateText(painter, QPointF(0, above * away), action.text);
    }
    painter->setOpacity(1.0);
  }
}

}  // namespace pitchboard::ui
