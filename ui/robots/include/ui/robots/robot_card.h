// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The card of a robot: badge, name, battery, lamps, action, chosen values. It draws a CardState and
// repaints only what changed. UI thread only.

#include <QFrame>
#include <QStringList>

#include <ui/robots/card_state.h>

namespace pitchboard::ui {

/// What all cards show besides badge and name.
struct CardParts {
  bool battery = true, processes = true, action = true, health = true;
  QStringList values;  ///< names of additional values, in the order shown
  bool operator==(const CardParts&) const = default;
};

class RobotCard : public QFrame {
  Q_OBJECT
 public:
  explicit RobotCard(QWidget* parent = nullptr);

  void setState(const CardState& state);
  const CardState& state() const { return m_state; }
  void setParts(const CardParts& parts);
  void setSelected(bool selected);
  bool isSelected() const { return m_selected; }
  void setCollapsed(bool collapsed);
  bool isCollapsed() const { return m_collapsed; }
  /// Returns whether the card is being dragged.
  bool isDragged() const { return m_dragging; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void clicked(Qt::KeyboardModifiers modifiers);
  void menuRequested(const QPoint& globalPosition);
  // The user drags the card within the list, or out of it.
  void dragged(const QPoint& globalPosition);
  void dropped(const QPoint& globalPosition);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  // 0 name, 1 lamps and tag, 2 action and health, from 3 on the values; empty when not shown.
  QRect rowRect(int row) const;
  int rowHeight(int row) const;  // mock pixels, 0 when not shown
  const CardValue* value(const QString& name) const;
  QRect lampRect(int lamp) const;
  bool isNarrow() const;
  QRect chevronRect() const;
  void paintFrame(QPainter& painter) const;
  void paintHead(QPainter& painter) const;
  void paintLamps(QPainter& painter) const;
  void paintTag(QPainter& painter) const;
  void paintFoot(QPainter& painter) const;
  void paintValues(QPainter& painter) const;
  QRect batteryRect() const;
  QRect voltsRect() const;
  QRect tagRect() const;
  bool showsTag() const;
  QString lampTip(int lamp) const;
  QString headTip() const;

  CardState m_state;
  CardParts m_parts;
  QPoint m_pressed;
  bool m_held = false;
  bool m_dragging = false;
  bool m_selected = false;
  bool m_collapsed = false;
};

}  // namespace pitchboard::ui
