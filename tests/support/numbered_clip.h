// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Clips for tests, made by the program ffmpeg. Every picture has its number painted in, as blocks
// that are white for 1 and black for 0, and is read back from a picture whatever its size. The
// first block is white and the one below it black, so that a picture that lies on its side has no
// number.

#include <QByteArray>
#include <QProcess>
#include <QStandardPaths>
#include <QStringList>
#include <optional>

namespace pitchboard::tests {

struct NumberedClip {
  static constexpr int columns = 5, rows = 3, bits = columns * rows - 2;
  static constexpr int block = 32, width = columns * block, height = rows * block;  // pixels

  /// Bit of the block at this place; -1: always white, -2: always black.
  static int bitAt(int column, int row) {
    if (column == 0 && row < 2) return row == 0 ? -1 : -2;
    const int place = row * columns + column;
    return place > columns ? place - 2 : place - 1;
  }

  /// A grey picture with this number, line by line.
  static QByteArray picture(int number) {
    QByteArray grey(width * height, '\0');
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int bit = bitAt(x / block, y / block);
        const bool white = bit == -1 || (bit >= 0 && ((number >> bit) & 1) != 0);
        grey[y * width + x] = static_cast<char>(white ? 235 : 16);
      }
    }
    return grey;
  }

  /// The number in a picture of any size; `greyAt(x, y)` gives 0 to 255. -1: there is none.
  template <class GreyAt>
  static int numberIn(int pictureWidth, int pictureHeight, const GreyAt& greyAt) {
    int number = 0;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const bool white = greyAt((2 * column + 1) * pictureWidth / (2 * columns),
                                  (2 * row + 1) * pictureHeight / (2 * rows)) > 127;
        const int bit = bitAt(column, row);
        if (bit < 0 && white != (bit == -1)) return -1;
        if (bit >= 0 && white) number |= 1 << bit;
      }
    }
    return number;
  }

  static bool canBeMade() {
    return !QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty();
  }

  /// Runs ffmpeg; returns its output, or nothing if it failed.
  static std::optional<QByteArray> ffmpeg(const QStringList& arguments,
                                          const QByteArray& input = {}) {
    QProcess process;
    process.setStandardErrorFile(QProcess::nullDevice());
    process.start(QStringLiteral("ffmpeg"),
                  QStringList{"-hide_banner", "-loglevel", "error", "-y"} + arguments);
    if (!process.waitForStarted()) return {};
    process.write(input);
    process.closeWriteChannel();
    if (!process.waitForFinished(120'000) || process.exitCode() != 0) return {};
    return process.readAllStandardOutput();
  }

  /// Makes a clip of so many pictures at 25 a second; `how` are the arguments of the output.
  /// Returns whether it could.
  static bool make(const QString& path, int pictures, const QStringList& how) {
    QByteArray all;
    for (int number = 0; number < pictures; ++number) all += picture(number);
    const QStringList input{
        "-f", "rawvideo", "-pix_fmt", "gray",  "-s", QStringLiteral("%1x%2").arg(width).arg(height),
        "-r", "25",       "-i",       "pipe:0"};
    return ffmpeg(input + how + QStringList{path}, all).has_value();
  }
};

}  // namespace pitchboard::tests
