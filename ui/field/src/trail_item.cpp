// SPDX-License-Identifier: GPL-3.0-or-later
#include "trail_item.h"

#include <QPaintEngine>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

/// Returns whether a line passes all these points within a fraction of a pixel.
bool passes(const QPointF& from, const QPointF& to, const QPointF* points, int count) {
  constexpr double tolerance_px = 0.6;
  const QPointF offset = to - from;
  const double most = tolerance_px * std::hypot(offset.x(), offset.y());
  return std::all_of(points, points + count, [&](const QPointF& point) {
    const QPointF off = point - from;
    return std::abs(offset.x() * off.y() - offset.y() * off.x()) <= most &&
           QPointF::dotProduct(offset, off) >= 0.0;
  });
}

}  // namespace

void TrailItem::clear() {
  if (m_count == 0) return;
  prepareGeometryChange();
  m_count = 0;
  m_bounds = QRectF();
}

void TrailItem::append(const Point& position, double time) {
  const QPointF at = toScene(position);
  if (m_count > 0 && (time < m_now || distance(at, m_tip) > maxJump)) clear();
  if (m_count > 0 && time == m_now && at == m_tip) return;
  const bool tipMoved = m_count == 0 || at != m_tip;
  m_now = time;
  m_tip = at;
  const int before = m_count;
  dropOld();
  bool changed = m_count != before;
  if (m_count == 0 || distance(at, mark(m_count - 1).at) >= step) {
    if (m_count == capacity) {
      m_first = (m_first + 1) % capacity;
      --m_count;
    }
    m_marks[static_cast<std::size_t>((m_first + m_count) % capacity)] = {at, time};
    ++m_count;
    changed = true;
  }
  if (changed) {
    updateBounds();
  } else if (tipMoved && m_count > 1) {
    update();
  }
}

void TrailItem::set(std::span<const Place> places) {
  clear();
  for (const Place& place : places) append(place.at, place.time);
}

void TrailItem::dropOld() {
  while (m_count > 0 && m_now - mark(0).time > seconds) {
    m_first = (m_first + 1) % capacity;
    --m_count;
  }
}

void TrailItem::updateBounds() {
  prepareGeometryChange();
  if (m_count == 0) {
    m_bounds = QRectF();
    return;
  }
  double left = m_tip.x(), right = left, low = m_tip.y(), high = low;
  for (int i = 0; i < m_count; ++i) {
    const QPointF& p = mark(i).at;
    left = std::min(left, p.x());
    right = std::max(right, p.x());
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  // The tip may run ahead by one step before the bounds are made again.
  m_bounds = QRectF(left, low, right - left, high - low).adjusted(-step, -step, step, step);
}

QRectF TrailItem::boundingRect() const {
  const double margin = m_style->metres(2.0);
  return m_bounds.adjusted(-margin, -margin, margin, margin);
}

void TrailItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (m_count < 2) return;
  // A few strokes of growing strength instead of one per point.
  constexpr int shades = 6;
  const ScreenPainting screen(painter, m_tip);
  const auto pixels = [&](const QPointF& at) { return screen.pixels(at - m_tip); };
  // Separate lines with flat caps: at this width no joint shows. On a screen without fine pixels
  // one pixel, a little stronger, since Qt needs twice as long for every wider line.
  constexpr double wide = 1.5;
  std::array<QLineF, capacity + 1> lines;
  const bool thin = painter->paintEngine()->type() == QPaintEngine::Raster &&
                    painter->device()->devicePixelRatioF() == 1.0;
  QPen pen(theme().fieldLines, thin ? 1.0 : wide);
  pen.setCapStyle(Qt::FlatCap);
  QPointF last = pixels(mark(0).at);
  // Far away marks stand closer than anybody sees, many in one straight line; and each line costs
  // the same however short.
  constexpr double shortest_px = 5.0;
  constexpr int mostPassed = 8;
  std::array<QPointF, mostPassed> passed;
  int i = 1;
  for (int shade = 0; shade < shades; ++shade) {
    const double until = m_now - seconds * (shades - 1 - shade) / shades;
    int used = 0, waiting = 0;
    const auto lineTo = [&](const QPointF& next) {
      lines[static_cast<std::size_t>(used++)] = QLineF(last, next);
      last = next;
      waiting = 0;
    };
    const auto goTo = [&](const QPointF& next) {
      if (waiting == mostPassed || !passes(last, next, passed.data(), waiting)) {
        lineTo(passed[static_cast<std::size_t>(waiting - 1)]);
      }
      passed[static_cast<std::size_t>(waiting++)] = next;
    };
    for (; i < m_count && mark(i).time <= until; ++i) {
      const QPointF next = pixels(mark(i).at);
      const QPointF& before = waiting > 0 ? passed[static_cast<std::size_t>(waiting - 1)] : last;
      if (distance(before, next) >= shortest_px) goTo(next);
    }
    if (shade == shades - 1) goTo(QPointF(0, 0));
    if (waiting > 0) lineTo(passed[static_cast<std::size_t>(waiting - 1)]);
    if (used == 0) continue;
    const double strength = 0.08 + 0.52 * (shade + 1) / shades;
    pen.setColor(onGrass(theme().fieldLines, thin ? 1.25 * strength : strength));
    painter->setPen(pen);
    painter->drawLines(lines.data(), used);
  }
}

}  // namespace pitchboard::ui
