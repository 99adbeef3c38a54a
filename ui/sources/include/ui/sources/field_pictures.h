// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures of the field for files and documents, without a window round it. The field makes them;
// whoever exports knows no more of it than this. UI thread only.

#include <QByteArray>
#include <QImage>
#include <QSize>
#include <memory>

#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

/// Paints moments one after another, each with score and time in the picture.
class FramePainter {
 public:
  virtual ~FramePainter() = default;
  /// `size` in pixels.
  virtual QImage paint(const FramePtr& frame, QSize size) = 0;
};

class FieldPictures {
 public:
  virtual ~FieldPictures() = default;
  /// The field as it is shown now, as large as it fits into `size` pixels.
  virtual QImage picture(QSize size) const = 0;
  /// The same as an SVG document, whose user unit is one pixel. Empty when it cannot be made.
  virtual QByteArray svgPicture(QSize size) const = 0;
  /// Paints other moments, with the side and the layers that are shown now; may outlive this.
  virtual std::unique_ptr<FramePainter> framePainter() const = 0;
};

}  // namespace pitchboard::ui
