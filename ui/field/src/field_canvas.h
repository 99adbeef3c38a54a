// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The window onto the scene: zoom, pan, side, background, and what is said when there is nothing to
// see. The mouse goes to the pointer; keys are the window's.

#include <QGraphicsView>
#include <functional>

#include "field_scene.h"

#include "field_background.h"

namespace pitchboard::ui {

class FieldPointer;

class FieldCanvas : public QGraphicsView {
  Q_OBJECT
 public:
  FieldCanvas(FieldScene* scene, FieldPointer* pointer, QWidget* parent);

  void fit();
  void setFlipped(bool flipped);
  void zoomAt(const QPointF& viewPoint, double factor);
  void centreOnMetres(const QPointF& metres);
  QPointF metresAt(const QPointF& viewPoint) const;
  QPointF viewPointAt(const QPointF& metres) const;
  /// Last place of the cursor in metres.
  QPointF cursor() const { return m_cursor; }

  /// While held, a drag with the left button pans. At the end: whether it was used for that.
  bool setPanHeld(bool held);

  /// What is said of the robot on which the mouse rests.
  void setHoverText(std::function<QString(const QPointF& metres)> text) {
    m_hoverText = std::move(text);
  }

  /// What to say while there are no robots; an empty text: how to begin a simulation.
  void setEmptyText(std::function<QString()> text) { m_emptyText = std::move(text); }

 signals:
  void cursorMoved(QPointF metres, bool valid);
  void menuRequested(QPoint globalPosition, QPointF metres);

 protected:
  bool viewportEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void drawBackground(QPainter* painter, const QRectF& rect) override;
  void drawForeground(QPainter* painter, const QRectF& rect) override;
  void scrollContentsBy(int dx, int dy) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void paintEmptyState(QPainter* painter) const;
  double fittingScale() const;
  void setScale(double pixelsPerMetre);
  void pan(const QPointF& to);
  void updateCursorShape();

  FieldScene* m_scene;
  FieldPointer* m_pointer;
  FieldBackground m_background;
  std::function<QString()> m_emptyText;
  std::function<QString(const QPointF&)> m_hoverText;
  QPointF m_cursor;
  QPointF m_panFrom;
  bool m_panning = false;
  bool m_panHeld = false;
  bool m_panUsed = false;
  bool m_fitted = true;
};

}  // namespace pitchboard::ui
