// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What robots have in mind: the particles of localization, the path that decision planned. Only
// robots that tell it have these (robotlink/cognition_debug.h).

#include <memory>

#include <base/team_color.h>
#include <robotlink/cognition/cognition_debug.h>
#include "field_item.h"

namespace pitchboard::ui {

/// A dot with a short line in its direction for every particle; unlikely ones are fainter.
class ParticlesItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setCloud(std::shared_ptr<const link::ParticleCloud> cloud, TeamColor team);
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  std::shared_ptr<const link::ParticleCloud> m_cloud;
  TeamColor m_team = TeamColor::Blue;
  QRectF m_bounds;
};

/// A line with a dot at every bend and a ring at the target; a cross where no way leads on.
class PlannedPathItem : public FieldItem {
 public:
  using FieldItem::FieldItem;
  void setPath(std::shared_ptr<const link::PlannedPath> path, TeamColor team);
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  std::shared_ptr<const link::PlannedPath> m_path;
  TeamColor m_team = TeamColor::Blue;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
