// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_map.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include <simcore/world/field_lines.h>
#include <telemetry/statistics/quantile.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

#include "statistics_text.h"

namespace pitchboard::ui {
namespace {

constexpr double cellSide = 0.25;     // m
constexpr double palest = 0.18;       // opacity of a square with a single sample
constexpr double lineWidth = 0.05;    // m
constexpr double legendHeight = 8.0;  // px of the design

/// The map "viridis" of matplotlib at even steps: readable without colours, and by everybody.
QColor scaleColor(double share) {
  static constexpr std::array<std::array<int, 3>, 6> steps{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(steps.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), steps.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto mixed = [&](std::size_t i) {
    return static_cast<int>(
        std::lround(steps[low][i] + part * (steps[low + 1][i] - steps[low][i])));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

}  // namespace

telemetry::MapGrid gridOf(const sim::FieldSpec& field) {
  const double halfLength = field.halfLength() + field.border;
  const double halfWidth = field.halfWidth() + field.border;
  return {-halfLength, -halfWidth, cellSide,
          static_cast<int>(std::ceil(2 * halfLength / cellSide - 1e-9)),
          static_cast<int>(std::ceil(2 * halfWidth / cellSide - 1e-9))};
}

FieldMap::FieldMap(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("fieldMap"));
  setAccessibleName(QStringLiteral("Mean over the field"));
  QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void FieldMap::show(const std::optional<telemetry::ValueMap>& map, const std::string& unit,
                    const sim::FieldSpec& field) {
  m_map = map;
  m_unit = unit;
  m_field = field;
  std::vector<double> means, counts;
  if (m_map) {
    for (std::size_t i = 0; i < m_map->counts.size(); ++i) {
      if (m_map->counts[i] == 0) continue;
      means.push_back(m_map->means[i]);
      counts.push_back(static_cast<double>(m_map->counts[i]));
    }
  }
  if (means.empty()) m_map.reset();
  std::ranges::sort(counts);
  if (m_map) {
    const auto [least, most] = std::ranges::minmax(means);
    m_least = least;
    m_most = most;
    m_usual = std::max(1.0, telemetry::quantile(counts, 0.5));
  }
  update();
}

QSize FieldMap::sizeHint() const {
  const int width = scaled(this, 200);
  return {width, heightForWidth(width)};
}

int FieldMap::heightForWidth(int width) const {
  const double proportion =
      (m_field.width + 2 * m_field.border) / (m_field.length + 2 * m_field.border);
  const QFontMetrics metrics(themeFont(TypeRole::Secondary));
  return static_cast<int>(width * proportion) + scaled(this, legendHeight) + metrics.height() +
         scaled(this, 8);
}

QRectF FieldMap::area() const {
  const double length = m_field.length + 2 * m_field.border;
  const double breadth = m_field.width + 2 * m_field.border;
  const QFontMetrics metrics(themeFont(TypeRole::Secondary));
  const double below = scaled(this, legendHeight) + metrics.height() + scaled(this, 8);
  const double scale = std::min(width() / length, (height() - below) / breadth);
  return {(width() - scale * length) / 2.0, 0.0, scale * length, scale * breadth};
}

QRectF FieldMap::cellArea(int column, int row) const {
  const QRectF area = this->area();
  const double pixels = area.width() / (m_field.length + 2 * m_field.border);
  const telemetry::MapGrid& grid = m_map->grid;
  const double left = area.center().x() + pixels * (grid.left + grid.cell * column);
  const double bottom = area.center().y() - pixels * (grid.bottom + grid.cell * row);
  return QRectF(left, bottom - pixels * grid.cell, pixels * grid.cell, pixels * grid.cell)
      .intersected(area);
}

void FieldMap::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setFont(themeFont(TypeRole::Secondary));
  const QRectF area = this->area();
  painter.fillRect(area, theme().view);
  if (m_map) {
    for (int row = 0; row < m_map->grid.rows; ++row) {
      for (int column = 0; column < m_map->grid.columns; ++column) {
        const auto i = static_cast<std::size_t>(row * m_map->grid.columns + column);
        if (m_map->counts[i] == 0) continue;
        QColor color =
            scaleColor(m_most > m_least ? (m_map->means[i] - m_least) / (m_most - m_least) : 0.5);
        const double share = static_cast<double>(m_map->counts[i]) / m_usual;
        color.setAlphaF(static_cast<float>(std::clamp(share, palest, 1.0)));
        painter.fillRect(cellArea(column, row), color);
      }
    }
    paintLegend(painter);
  }
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(area);
  painter.translate(area.center());
  const double pixels = area.width() / (m_field.length + 2 * m_field.border);
  painter.scale(pixels, -pixels);
  const sim::FieldLines shapes = sim::fieldLines(m_field, lineWidth);
  for (const auto& line : shapes.lines) {
    painter.fillRect(QRectF(QPointF(line.low.x, line.low.y), QPointF(line.high.x, line.high.y)),
                     theme().secondaryText);
  }
  painter.setPen(QPen(theme().secondaryText, lineWidth));
  if (shapes.circleRadius > 0) {
    painter.drawEllipse(QPointF(), shapes.circleRadius, shapes.circleRadius);
  }
  painter.restore();
  if (m_map) return;
  painter.setPen(theme().secondaryText);
  painter.drawText(QRectF(0, area.bottom(), width(), height() - area.bottom()),
                   Qt::AlignCenter | Qt::TextWordWrap,
                   QStringLiteral("No sample has a known place"));
}

void FieldMap::paintLegend(QPainter& painter) const {
  const QRectF area = this->area();
  const QRectF bar(area.left(), area.bottom() + scaled(this, 4), area.width(),
                   scaled(this, legendHeight));
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  constexpr int stops = 10;
  for (int i = 0; i <= stops; ++i) {
    const double share = static_cast<double>(i) / stops;
    gradient.setColorAt(share, scaleColor(share));
  }
  painter.fillRect(bar, gradient);
  painter.setPen(theme().secondaryText);
  const QRectF words(bar.left(), bar.bottom(), bar.width(), height() - bar.bottom());
  painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter, shortValueText(m_least, m_unit));
  painter.drawText(words, Qt::AlignRight | Qt::AlignVCenter, shortValueText(m_most, m_unit));
  painter.drawText(words, Qt::AlignCenter, QStringLiteral("pale: few samples"));
}

QString FieldMap::textAt(const QPoint& place) const {
  const QRectF area = this->area();
  if (!m_map || !area.contains(place)) return {};
  const double pixels = area.width() / (m_field.length + 2 * m_field.border);
  const double x = (place.x() - area.center().x()) / pixels;
  const double y = (area.center().y() - place.y()) / pixels;
  const telemetry::MapGrid& grid = m_map->grid;
  const int column = static_cast<int>(std::floor((x - grid.left) / grid.cell));
  const int row = static_cast<int>(std::floor((y - grid.bottom) / grid.cell));
  if (column < 0 || row < 0 || column >= grid.columns || row >= grid.rows) return {};
  const auto i = static_cast<std::size_t>(row * grid.columns + column);
  if (m_map->counts[i] == 0) return {};
  return QStringLiteral("Mean %1 of %2 samples at x %3, y %4 m")
      .arg(shortValueText(m_map->means[i], m_unit), countText(m_map->counts[i]), numberText(x, 1),
           numberText(y, 1));
}

bool FieldMap::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const QString text = textAt(static_cast<QHelpEvent*>(event)->pos());
  if (text.isEmpty()) {
    QToolTip::hideText();
  } else {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, this);
  }
  return true;
}

}  // namespace pitchboard::ui
