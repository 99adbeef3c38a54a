// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Recordings on one clock: a bar for each, which can be dragged, or moved with the arrow keys, to
// where it belongs. UI thread only; s from the first message.

#include <QWidget>
#include <vector>

#include <robotlink/import/mapping_sample.h>

namespace pitchboard::ui {

class OffsetStrip : public QWidget {
  Q_OBJECT
 public:
  explicit OffsetStrip(QWidget* parent);

  void setRecordings(const std::vector<link::SampledRecording>& recordings);
  /// Where the bar of a recording is, in the widget.
  QRectF barOf(std::size_t recording) const;
  QSize sizeHint() const override;

 signals:
  /// A bar was moved by this many seconds.
  void moved(std::size_t recording, double seconds);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  double pixelsPerSecond() const;
  int rowHeight() const;

  std::vector<link::SampledRecording> m_recordings;
  double m_begin = 0.0, m_end = 1.0;  ///< s, that the width shows
  std::size_t m_current = 0;          ///< that keys move
  bool m_isDragged = false;
  double m_pressedAt = 0.0, m_dragged = 0.0;  ///< px; s
};

}  // namespace pitchboard::ui
