// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How large a dialog opens: as it likes, and never larger than its screen has room for with a
// frame. UI thread.

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
