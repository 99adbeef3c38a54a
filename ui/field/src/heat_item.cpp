// SPDX-License-Identifier: GPL-3.0-or-later
#include "heat_item.h"

#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double strongest = 0.85;  // opacity of the strongest cell

}  // namespace

void HeatItem::setHeat(BallHeatPtr heat, const QColor& color) {
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

}  // namespace pitchboard::ui
