// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One robot's card: badge, name, battery, lamps, action. Draws a CardState and nothing else; only
// what changed is painted again. UI thread only.

#include <QFrame>

#include "card_state.h"

namespace pitchboard::ui {

class RobotCard : public QFrame {
  Q_OBJECT
 public:
  explicit RobotCard(QWidget* parent = nullptr);

  void setState(const CardState& state);
  const CardState& state() const { return m_state; }
  void setSelected(bool selected);
  bool isSelected() const { return m_selected; }
  void setCollapsed(bool collapsed);
  bool isCollapsed() const { return m_collapsed; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void clicked(Qt::KeyboardModifiers modifiers);
  void menuRequested(const QPoint& globalPosition);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  QRect rowRect(int row) const;        // 0 name, 1 lamps, 2 action
  QRect lampRect(int lamp) const;
  QRect chevronRect() const;
  void paintFrame(QPainter& painter) const;
  void paintHead(QPainter& painter) const;
  void paintLamps(QPainter& painter) const;
  void paintTag(QPainter& painter) const;
  void paintFoot(QPainter& painter) const;
  QString lampTip(int lamp) const;

  CardState m_state;
  bool m_selected = false;
  bool m_collapsed = false;
};

}  // namespace pitchboard::ui
