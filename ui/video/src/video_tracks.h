// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows when each video was recorded, as a bar along the time of the session, and aligns it: a bar
// is dragged until the picture of the moment that is shown fits. The wheel zooms, a double click
// shows everything. Seconds of the session. UI thread only; owned by the panel.

#include <QWidget>
#include <optional>
#include <vector>

#include <ui/base/time_axis.h>

#include "video_camera.h"

namespace pitchboard::ui {

class ShownMoment;

class VideoTracks : public QWidget {
  Q_OBJECT
 public:
  VideoTracks(ShownMoment* shown, QWidget* parent);

  /// A row for each; all are open. Ends a drag.
  void setCameras(std::vector<VideoCamera*> cameras);
  /// Returns the bar of a camera; empty if it is out of sight.
  QRectF barRect(std::size_t row) const;
  const TimeAxis& axis() const { return m_axis; }
  /// Returns how far the bar that is dragged has moved and where it begins: "+1.20 s, starts at
  /// 00:03.20"; empty while none is dragged.
  QString moveText() const;
  /// Puts a bar that is dragged back; returns whether there was one.
  bool cancel();
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void pressed(pitchboard::ui::VideoCamera* camera);
  /// The bar was dragged to where it is; before, its alignment was this.
  void dragged(pitchboard::ui::VideoCamera* camera,
               const std::vector<pitchboard::telemetry::VideoAnchor>& before);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  struct Drag {
    std::size_t row = 0;
    double pressedAt = 0.0;  // px
    std::vector<telemetry::VideoAnchor> before;
    telemetry::VideoAlignment alignment;  // before
    bool hasMoved = false;
  };
  void refresh();
  QRectF rowRect(std::size_t row) const;
  QRectF barOf(std::size_t row, const telemetry::VideoAlignment& alignment) const;
  std::optional<std::size_t> barAt(const QPointF& at) const;
  void paintBar(QPainter& painter, std::size_t row) const;

  ShownMoment* m_shown;
  std::vector<VideoCamera*> m_cameras;
  TimeAxis m_axis;
  bool m_showsAll = true;
  std::optional<Drag> m_drag;
};

}  // namespace pitchboard::ui
