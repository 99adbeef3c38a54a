// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Qualitative space round the selected robot: EOPRA (directions and distance rings) and StarVars
// (directions), as in system.md section 9.

#include <vector>

#include "field_item.h"

namespace pitchboard::ui {

/// Radii of the EOPRA rings in metres for granularity m: e·δ/m up to δ for e = 0..m, and beyond it
/// δ·m/(2m − e) for e = m+1..2m−1.
std::vector<double> eopraRings(int granularity, double delta = 1.0);

class SectorItem : public FieldItem {
 public:
  enum class Kind { Eopra, StarVars };
  SectorItem(const FieldStyle* style, Kind kind) : FieldItem(style), m_kind(kind) {}

  void setPose(const Pose& pose);

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  void paintSectors(QPainter* painter) const;
  void paintEopra(QPainter* painter, const ScreenPainting& screen) const;
  void paintStarVars(QPainter* painter, const ScreenPainting& screen) const;
  double reach() const;

  Kind m_kind;
  double m_yaw = 0.0;
};

}  // namespace pitchboard::ui
