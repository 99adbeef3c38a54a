// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Completes a QSaveFile safely. Any thread.

#include <QSaveFile>

namespace pitchboard::ui {

/// Replaces the old file only if every byte has been written. QSaveFile::commit() of Qt 6.4 does
/// not notice a full disk while writing its last buffer, so that small files would be lost.
inline bool commitWhole(QSaveFile& file) {
  return file.flush() && file.commit();
}

}  // namespace pitchboard::ui
