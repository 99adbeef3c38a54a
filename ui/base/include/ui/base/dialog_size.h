// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes the initial size of a dialog: the wanted one, limited by its screen minus a window
// frame. UI thread only.

#include <QScreen>
#include <QWidget>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// `width` and `height` are in pixels of the design, as for scaled().
inline QSize dialogSize(const QWidget* dialog, int width, int height) {
  const QSize wanted(scaled(dialog, width), scaled(dialog, height));
  const QScreen* screen = dialog->screen();
  if (screen == nullptr) return wanted;
  const QSize frame(scaled(dialog, 16), scaled(dialog, 44));
  return wanted.boundedTo(screen->availableSize() - frame);
}

}  // namespace pitchboard::ui
