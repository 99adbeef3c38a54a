// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures of a video: each moment on a field of its own, with the layers of a style. UI thread
// only.

#include <ui/sources/field_pictures.h>

#include "field_scene.h"

namespace pitchboard::ui {

class FilmPainter : public FramePainter {
 public:
  /// Side and layers are taken from `style`.
  explicit FilmPainter(const FieldStyle& style);
  QImage paint(const FramePtr& frame, QSize size) override;

 private:
  FieldScene m_scene;
};

}  // namespace pitchboard::ui
