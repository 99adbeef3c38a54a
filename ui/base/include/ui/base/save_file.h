// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The end of writing a file beside its old one. Any thread.

#include <QSaveFile>

namespace pitchboard::ui {

/// Takes the place of the old file, only when every byte is written. QSaveFile::commit() of Qt 6.4
/// does not notice a disk that is full for the bytes which it still has in memory: small files
/// would be lost.
inline bool commitWhole(QSaveFile& file) {
  return file.flush() && file.commit();
}

}  // namespace pitchboard::ui
