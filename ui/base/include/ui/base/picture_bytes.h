// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Encodes a picture in memory, so that our own file writer writes it and reports a full disk. Any
// thread.

#include <QBuffer>
#include <QByteArray>
#include <QImage>

namespace pitchboard::ui {

/// Returns nothing if Qt cannot write this format. `format` is the file's suffix.
inline QByteArray pictureBytes(const QImage& picture, const char* format = "png") {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  return picture.save(&buffer, format) ? bytes : QByteArray();
}

}  // namespace pitchboard::ui
