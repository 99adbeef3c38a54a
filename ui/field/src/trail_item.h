// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a robot has been: a line that fades with age. Bounded in time and in points.

#include <array>
#include <span>

#include "field_item.h"

namespace pitchboard::ui {

class TrailItem : public FieldItem {
 public:
  static constexpr double seconds = 8.0;  ///< simulated
  static constexpr double step = 0.03;    ///< metres between points
  static constexpr double maxJump = 0.4;  ///< metres; more is a move by hand, not a walk

  using FieldItem::FieldItem;

  struct Place {
    Point at;
    double time = 0.0;  ///< s
  };

  double now() const { return m_now; }  ///< of its end, s
  /// `time` in simulated seconds; going back in time or jumping starts the trail again.
  void append(const Point& position, double time);
  /// The trail is this one now, in order of time.
  void set(std::span<const Place> places);
  void clear();

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  static constexpr int capacity = 128;
  struct Mark {
    QPointF at;
    double time = 0.0;
  };
  const Mark& mark(int i) const {
    return m_marks[static_cast<std::size_t>((m_first + i) % capacity)];
  }
  void dropOld();
  void updateBounds();

  std::array<Mark, capacity> m_marks;  // ring
  int m_first = 0;
  int m_count = 0;
  QPointF m_tip;
  double m_now = 0.0;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
