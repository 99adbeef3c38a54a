// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_painter.h"

#include <algorithm>

#include <ui/base/scoreboard_state.h>
#include <ui/base/theme.h>

#include "field_picture.h"

namespace pitchboard::ui {
namespace {

/// Score and time stand in the picture: a video has no window round it that says them.
void paintCaption(QImage& picture, const link::MatchFrame& frame) {
  const ScoreboardState score = scoreboardOf(frame);
  const int high = std::max(picture.height() / 36, 11);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  drawHaloText(&painter, {picture.width() / 2.0, high * 0.9},
               QStringLiteral("%1  %2 : %3  %4    %5")
                       .arg(score.leftName)
                       .arg(score.left)
                       .arg(score.right)
                       .arg(score.rightName)
                       .arg(frame.snapshot.time, 0, 'f', 1) +
                   QStringLiteral(" s"),
               fieldFont(high, true), theme().fieldLines, theme().fieldBorder.darker(150));
}

}  // namespace

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
  QImage picture = paintPicture(m_scene, size);
  paintCaption(picture, *frame);
  return picture;
}

}  // namespace pitchboard::ui
