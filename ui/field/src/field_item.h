// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Anything that is drawn on the field as the field's style says. UI thread; belongs to the scene.

#include <QGraphicsItem>

#include "field_style.h"

namespace pitchboard::ui {

class FieldItem : public QGraphicsItem {
 public:
  /// `style` outlives it.
  explicit FieldItem(const FieldStyle* style) : m_style(style) {}
  /// Zoom, side or field are others now, and with them what the item covers.
  virtual void styleChanges() { prepareGeometryChange(); }

 protected:
  const FieldStyle* m_style;
};

}  // namespace pitchboard::ui
