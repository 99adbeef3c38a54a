// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes pictures of the field for files and documents. The field implements it, so that exporting
// does not depend on the field. UI thread only.

#include <QByteArray>
#include <QImage>
#include <QSize>
#include <memory>

#include <ui/base/picture_bytes.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

/// Paints moments one after another.
class FramePainter {
 public:
  virtual ~FramePainter() = default;
  /// `size` in pixels.
  virtual QImage paint(const FramePtr& frame, QSize size) = 0;
};

class FieldPictures {
 public:
  virtual ~FieldPictures() = default;
  /// Returns the largest size within `within` (pixels) with the proportions of the field; width and
  /// height are even.
  virtual QSize pictureSize(QSize within) const = 0;
  /// Returns the field as it is shown now, fitted into `size` pixels, with score, clock and state.
  virtual QImage picture(QSize size) const = 0;
  /// Returns the same as an SVG document whose user unit is a pixel; empty on failure.
  virtual QByteArray svgPicture(QSize size) const = 0;
  /// Returns a picture with pictureSize() as the bytes of a file with this suffix ("png", "svg");
  /// empty on failure.
  QByteArray pictureFile(QSize within, const QString& suffix) const {
    const QSize size = pictureSize(within);
    return suffix.toLower() == QLatin1String("svg")
               ? svgPicture(size)
               : pictureBytes(picture(size), suffix.toLatin1().constData());
  }
  /// Returns a painter for other moments, with the current side and layers. It may outlive this.
  virtual std::unique_ptr<FramePainter> framePainter() const = 0;
};

}  // namespace pitchboard::ui
