// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a window shares its room out at first: the field gets more than half of the height, panels
// what they need. Pure; any thread.

#include <QSize>
#include <algorithm>

namespace pitchboard::ui {

/// Widths of the panels at the left and the right, height of those below the field. All in pixels
/// of the mock.
struct Extents {
  int left, right, bottom;
};

/// The smallest window, in pixels of the mock. Panels are cut before it grows.
constexpr QSize minWindow{640, 400};

constexpr Extents extentsFor(QSize window) {
  const int wide = window.width(), high = window.height();
  Extents extents{};
  extents.left = wide < 1100 ? 208 : wide < 1400 ? 232 : 256;
  extents.right = wide < 1100 ? 280 : wide < 1400 ? 356 : 416;
  // From a laptop's screen on: a plot whose curve has 110 px, and a lane. Below, a single row of
  // curves; it grows by a drag.
  constexpr int laptop = 740, withLane = 219;
  extents.bottom = high < 560      ? 100
                   : high < laptop ? 130
                                   : withLane + std::max(0, high - 900) * 22 / 100;
  return extents;
}

}  // namespace pitchboard::ui
