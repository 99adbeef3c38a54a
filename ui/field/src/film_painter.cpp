// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_painter.h"

#include "field_picture.h"

namespace pitchboard::ui {
FilmPainter::FilmPainter(const FieldStyle& style) {
  m_scene.changeStyle([&style](FieldStyle& own) {
    own.layers = style.layers;
    own.drawings = style.drawings;
    own.drawings.onlySelected = false;  // nothing is selected in a film
    own.flipped = style.flipped;
    own.wedgeForAll = style.wedgeForAll;
    own.eopraGranularity = style.eopraGranularity;
    own.readOnly = true;
  });
}

QImage FilmPainter::paint(const FramePtr& frame, QSize size) {
  m_scene.showFrame(frame);
  return paintPicture(m_scene, size);
}

}  // namespace pitchboard::ui
