// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures of the field for files and documents, without a window round it. The field makes them;
// whoever exports knows no more of it than this. UI thread only.

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
  /// The largest picture within `size` pixels that the field fills; both sides are even.
  virtual QSize pictureSize(QSize within) const = 0;
  /// The field as it is shown now, as large as it fits into `size` pixels, with score, match clock
  /// and state.
  virtual QImage picture(QSize size) const = 0;
  /// The same as an SVG document, whose user unit is one pixel. Empty when it cannot be made.
  virtual QByteArray svgPicture(QSize size) const = 0;
  /// The bytes of a file whose name ends so ("png", "svg"): a picture within these pixels that the
  /// field fills. Empty when it cannot be made.
  QByteArray pictureFile(QSize within, const QString& suffix) const {
    const QSize size = pictureSize(within);
    return suffix.toLower() == QLatin1String("svg")
               ? svgPicture(size)
               : pictureBytes(picture(size), suffix.toLatin1().constData());
  }
  /// Paints other moments, with the side and the layers that are shown now; may outlive this.
  virtual std::unique_ptr<FramePainter> framePainter() const = 0;
};

}  // namespace pitchboard::ui
