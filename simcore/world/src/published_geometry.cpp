// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/published_geometry.h>

#include <cmath>

namespace pitchboard::sim {
namespace {

/// Centimetres to 0.01 cm, so that sizes written in metres give the published whole numbers.
double cm(double metres) {
  return std::round(metres * 10000.0) / 100.0;
}

}  // namespace

PublishedGeometry::PublishedGeometry(const FieldSpec& f)
    : left(cm(f.border)),
      right(cm(f.border + f.length)),
      top(cm(f.border)),
      bottom(cm(f.border + f.width)),
      worldWidth(cm(2 * f.border + f.length)),
      worldHeight(cm(2 * f.border + f.width)),
      goalDepth(cm(f.goalDepth)),
      goalTop(cm(f.border + f.width / 2 - f.goalWidth / 2)),
      goalBottom(cm(f.border + f.width / 2 + f.goalWidth / 2)),
      robotRadius(cm(f.robotRadius)),
      ballRadius(cm(f.ballRadius)),
      postRadius(cm(f.goalPostRadius)) {
  lines = {{
      {true, 0, worldWidth, 0},
      {true, 0, worldWidth, worldHeight},
      {false, 0, worldHeight, 0},
      {false, 0, worldHeight, worldWidth},
      {true, left - goalDepth, left, goalTop},
      {true, left - goalDepth, left, goalBottom},
      {true, right, right + goalDepth, goalTop},
      {true, right, right + goalDepth, goalBottom},
  }};
  posts = {{{left, goalTop}, {left, goalBottom}, {right, goalTop}, {right, goalBottom}}};
  landmarks = {{{left, top}, {right, top}, {left, bottom}, {right, bottom}}};
}

}  // namespace pitchboard::sim
