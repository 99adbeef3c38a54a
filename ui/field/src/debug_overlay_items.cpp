// SPDX-License-Identifier: GPL-3.0-or-later
#include "debug_overlay_items.h"

#include <QVarLengthArray>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double dotSize_px = 2.6, tickLength_px = 6.0;
constexpr double bendRadius_px = 2.5, targetRadius_px = 5.0;

class Bounds {
 public:
  void add(const Point& p) {
    const QRectF dot(p.x, p.y, 0, 0);
    // A rectangle without area would be lost in |=.
    if (m_any) {
      m_rect.setCoords(std::min(m_rect.left(), p.x), std::min(m_rect.top(), p.y),
                       std::max(m_rect.right(), p.x), std::max(m_rect.bottom(), p.y));
    } else {
      m_rect = dot;
    }
    m_any = true;
  }
  QRectF rect() const { return m_rect; }

 private:
  QRectF m_rect;
  bool m_any = false;
};

/// Of the team, so bright or dark that it stands out from the grass.
QColor markColor(TeamColor team, double opacity) {
  const QColor color = theme().team(team);
  return onGrass(isDarkTheme() ? color.lighter(125) : color.darker(115), opacity);
}

QRectF withMargin(const QRectF& rect, double margin) {
  return rect.adjusted(-margin, -margin, margin, margin);
}

}  // namespace

void ParticlesItem::setCloud(std::shared_ptr<const link::ParticleCloud> cloud, TeamColor team) {
  if (cloud == m_cloud && team == m_team) return;
  prepareGeometryChange();
  m_cloud = std::move(cloud);
  m_team = team;
  Bounds bounds;
  if (m_cloud) {
    for (const link::Particle& particle : m_cloud->particles) bounds.add(particle.position);
  }
  m_bounds = bounds.rect();
  update();
}

QRectF ParticlesItem::boundingRect() const {
  return withMargin(m_bounds, m_style->metres(tickLength_px + 2.0));
}

void ParticlesItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (!m_cloud || m_cloud->particles.empty()) return;
  const QPointF origin = toScene(m_cloud->particles.front().position);
  const ScreenPainting screen(painter, origin);
  const QRectF area = m_style->playingArea();
  const double even = 1.0 / static_cast<double>(m_cloud->particles.size());
  // One stroke per shade: five hundred changes of the pen would cost more than the lines.
  constexpr std::array<double, 3> opacities{0.35, 0.65, 0.95};
  std::array<QVarLengthArray<QPointF, 512>, opacities.size()> dots;
  std::array<QVarLengthArray<QLineF, 512>, opacities.size()> ticks;
  for (const link::Particle& particle : m_cloud->particles) {
    const QPointF at = toScene(particle.position);
    if (!area.contains(at)) continue;
    const std::size_t shade = particle.weight < 0.3 * even   ? 0
                              : particle.weight < 0.9 * even ? 1
                                                             : 2;
    const QPointF place = screen.pixels(at - origin);
    dots[shade].append(place);
    ticks[shade].append(QLineF(place, place + tickLength_px * screen.direction(particle.yaw)));
  }
  for (std::size_t shade = 0; shade < opacities.size(); ++shade) {
    const QColor color = markColor(m_team, opacities[shade]);
    QPen pen(color, 0.0);
    painter->setPen(pen);
    painter->drawLines(ticks[shade].constData(), static_cast<int>(ticks[shade].size()));
    pen.setWidthF(dotSize_px);
    pen.setCapStyle(Qt::RoundCap);
    painter->setPen(pen);
    painter->drawPoints(dots[shade].constData(), static_cast<int>(dots[shade].size()));
  }
}

void PlannedPathItem::setPath(std::shared_ptr<const link::PlannedPath> path, TeamColor team) {
  if (path == m_path && team == m_team) return;
  prepareGeometryChange();
  m_path = std::move(path);
  m_team = team;
  Bounds bounds;
  if (m_path) {
    for (const Point& point : m_path->points) bounds.add(point);
  }
  m_bounds = bounds.rect();
  update();
}

QRectF PlannedPathItem::boundingRect() const {
  return withMargin(m_bounds, m_style->metres(targetRadius_px + 3.0));
}

void PlannedPathItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (!m_path || m_path->points.size() < 2) return;
  const QPointF origin = toScene(m_path->points.front());
  const ScreenPainting screen(painter, origin);
  QPolygonF line;
  for (const Point& point : m_path->points) line << screen.pixels(toScene(point) - origin);
  const QColor color = markColor(m_team, 1.0);

  // The end of the line touches the ring and does not run into it.
  const QPointF target = line.last(), before = line[line.size() - 2];
  const QPointF last = target - before;
  const double length = std::hypot(last.x(), last.y());
  if (length > targetRadius_px)
    line.last() = target - last * (targetRadius_px / length);
  else
    line.removeLast();

  const auto stroke = [&](const QColor& c, double width) {
    QPen pen(c, width);
    pen.setJoinStyle(Qt::RoundJoin);
    pen.setCapStyle(Qt::RoundCap);
    painter->setPen(pen);
    painter->setBrush(Qt::NoBrush);
    painter->drawPolyline(line);
    if (m_path->complete) {
      painter->drawEllipse(target, targetRadius_px, targetRadius_px);
    } else {
      const double reach = 0.8 * targetRadius_px;
      painter->drawLine(target + QPointF(-reach, -reach), target + QPointF(reach, reach));
      painter->drawLine(target + QPointF(-reach, reach), target + QPointF(reach, -reach));
    }
  };
  stroke(onGrass(theme().fieldLines, 0.75), 3.6);  // a rim, so that it reads on lines and robots
  stroke(color, 1.8);
  painter->setPen(Qt::NoPen);
  painter->setBrush(color);
  for (qsizetype i = 1; i + 1 < line.size(); ++i) {
    painter->drawEllipse(line[i], bendRadius_px, bendRadius_px);
  }
}

}  // namespace pitchboard::ui
