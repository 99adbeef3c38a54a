// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows the picture of a camera, with the field in it, and takes clicks on points of the field. UI
// thread only; owned by the panel.

#include <QWidget>
#include <optional>

#include <ui/sources/frame_source.h>

#include "field_overlay.h"

namespace pitchboard::ui {

class VideoCamera;

class VideoView : public QWidget {
  Q_OBJECT
 public:
  /// The camera must outlive it.
  VideoView(VideoCamera* camera, QWidget* parent);

  VideoCamera* camera() const { return m_camera; }
  /// Returns how many pixels of the screen a picture can fill.
  QSize room() const;
  /// Returns where the picture is; empty while there is none.
  QRectF pictureRect() const;
  /// The frame that is drawn into the picture; null: none.
  void setFrame(FramePtr frame);
  void setOverlay(bool on);
  /// The camera to which the bars of the panel belong.
  void setCurrent(bool on, bool isOneOfSeveral);
  /// Shows points of the field, which can be dragged. The next click stands for `next`, if there is
  /// one.
  void setPlacing(bool on, std::optional<Point> next);
  bool isPlacing() const { return m_placing; }

 signals:
  void pressed();
  /// The point was clicked, here in the picture (shares of width and height).
  void placed(const pitchboard::Point& picture);
  void resized();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  QSize sizeHint() const override;

 private:
  Point inPicture(const QPointF& pixel) const;
  QPointF onScreen(const Point& picture) const;
  std::optional<std::size_t> landmarkAt(const QPointF& pixel) const;
  QString remark() const;
  void paintField(QPainter& painter);
  void paintPoints(QPainter& painter);
  void paintMap(QPainter& painter);
  void paintCaption(QPainter& painter);

  VideoCamera* m_camera;
  FramePtr m_frame;
  bool m_overlay = false, m_current = false, m_several = false, m_placing = false;
  bool m_mapOnTheLeft = false;  // away from the pointer
  std::optional<Point> m_next;
  std::optional<std::size_t> m_dragged;  // index of the landmark
};

}  // namespace pitchboard::ui
