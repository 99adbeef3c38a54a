// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What robots have in mind: the particles of localization, the path that decision planned. Only
// robots that tell it have these (robotlink/robot_thoughts.h).

#include <QGraphicsItem>
#include <memory>

#include <base/ids.h>
#include <robotlink/cognition/robot_thoughts.h>
#include "field_style.h"

namespace pitchboard::ui {

/// A dot with a short line in its direction for every particle; unlikely ones are fainter.
class ParticlesItem : public QGraphicsItem {
 public:
  explicit ParticlesItem(const FieldStyle* style) : m_style(style) {}
  void setCloud(std::shared_ptr<const link::ParticleCloud> cloud, TeamColor team);
  void styleChanges() { prepareGeometryChange(); }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  const FieldStyle* m_style;
  std::shared_ptr<const link::ParticleCloud> m_cloud;
  TeamColor m_team = TeamColor::Blue;
  QRectF m_bounds;
};

/// A line with a dot at every bend and a ring at the target; a cross where no way leads on.
class PlannedPathItem : public QGraphicsItem {
 public:
  explicit PlannedPathItem(const FieldStyle* style) : m_style(style) {}
  void setPath(std::shared_ptr<const link::PlannedPath> path, TeamColor team);
  void styleChanges() { prepareGeometryChange(); }
  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  const FieldStyle* m_style;
  std::shared_ptr<const link::PlannedPath> m_path;
  TeamColor m_team = TeamColor::Blue;
  QRectF m_bounds;
};

}  // namespace pitchboard::ui
