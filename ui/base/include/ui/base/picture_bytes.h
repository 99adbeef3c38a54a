// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A picture as the bytes of a file. It is made in memory and written as a whole: a disk that
// becomes full is told by the one writer of files, not by the library of a format. UI thread or any
// other.

#include <QBuffer>
#include <QByteArray>
#include <QImage>

namespace pitchboard::ui {

/// Empty when nobody writes this format; `format` as a file's name ends.
inline QByteArray pictureBytes(const QImage& picture, const char* format = "png") {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  return picture.save(&buffer, format) ? bytes : QByteArray();
}

}  // namespace pitchboard::ui
