// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The cards of all robots, refreshed ten times a second. Selects both ways with the field.

#include <QElapsedTimer>
#include <QScrollArea>

#include "card_state.h"
#include "shell/dock_list.h"

class QLabel;
class QVBoxLayout;

namespace pitchboard::ui {

class RobotCard;

class RobotsDock : public QScrollArea {
  Q_OBJECT
 public:
  RobotsDock(const StudioContext& context, QWidget* parent);
  QList<RobotCard*> cards() const { return m_cards; }
  void setAllCollapsed(bool collapsed);
  QSize sizeHint() const override;

 private:
  void refresh();
  void showSelection();
  void makeCards(std::size_t count);
  void showMenu(RobotCard* card, const QPoint& at);

  StudioContext m_context;
  CardTracker m_tracker;
  QElapsedTimer m_clock;
  QList<RobotCard*> m_cards;
  QVBoxLayout* m_column;
  QLabel* m_empty;
};

QWidget* makeRobotsDock(const StudioContext& context, QWidget* parent);

}  // namespace pitchboard::ui
