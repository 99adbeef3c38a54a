// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Robots dock: the cards of all robots, refreshed ten times a second. The selection is shared
// with the field. Cards can be reordered by dragging, or dragged out into a window of their own;
// what they show is chosen in their menu and kept in the settings. UI thread only.

#include <QElapsedTimer>
#include <QScrollArea>
#include <map>
#include <set>

#include <ui/base/beat.h>
#include <ui/robots/card_state.h>
#include <ui/robots/robot_card.h>

class QDockWidget;
class QFrame;
class QLabel;
class QMenu;
class QSettings;
class QVBoxLayout;

namespace pitchboard::ui {

class LiveController;
class LiveOverlay;
class MatchController;
class RobotSelection;
class ShownMoment;

/// What the dock shows and changes; all must outlive it.
struct RobotsContext {
  MatchController* controller = nullptr;
  ShownMoment* shown = nullptr;
  RobotSelection* selection = nullptr;
  LiveOverlay* overlay = nullptr;  ///< cards show the distance to the other source; may be null
  QSettings* settings = nullptr;   ///< the user's; may be null
  LiveController* live = nullptr;  ///< to forget robots; may be null
};

class RobotsDock : public QScrollArea {
  Q_OBJECT
 public:
  RobotsDock(const RobotsContext& context, QWidget* parent);
  /// Returns the cards in the list from the top, without those that float.
  QList<RobotCard*> cards() const;
  void setAllCollapsed(bool collapsed);
  /// Moves the card into a window of its own; closing the window puts it back.
  void floatCard(RobotUid id);
  QDockWidget* floating(RobotUid id) const;
  /// Moves the card before the one with this index in the list.
  void moveCard(RobotUid id, qsizetype place);
  void setParts(const CardParts& parts);
  const CardParts& parts() const { return m_parts; }
  /// Adds the actions for cards to the menu bar.
  void addCardActions(QMenu& menu);
  /// With at least this many robots, new cards are collapsed. Those that are there stay as they
  /// are.
  static constexpr std::size_t many = 9;
  QSize sizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  std::vector<CardState> states();
  void showSelection();
  void showCards(const std::vector<CardState>& states);
  RobotCard* makeCard();
  void removeCard(RobotUid robot);
  bool sortCards();
  void arrange();
  void unfloat(RobotUid id);
  void follow(RobotCard* card, const QPoint& globalPosition);
  void drop(RobotCard* card, const QPoint& globalPosition);
  void loadParts();
  void showMenu(RobotCard* card, const QPoint& at);
  void addMatchActions(QMenu& menu, RobotCard* card);
  void addPartActions(QMenu& menu, RobotCard* card);
  void addListActions(QMenu& menu);
  void addForgetting(QMenu& menu, RobotCard* card);
  qsizetype placeAt(RobotCard* card, const QPoint& globalPosition) const;
  void showDropMark(qsizetype place);

  RobotsContext m_context;
  CardTracker m_tracker;
  QElapsedTimer m_clock;
  std::unique_ptr<Beat::Part> m_refresh;
  CardParts m_parts;
  std::map<RobotUid, RobotCard*> m_cards;
  std::map<RobotUid, QDockWidget*> m_floating;
  std::map<RobotUid, RobotOrder> m_places;  // in lists, when seen last
  std::vector<RobotUid> m_order;            // also of robots that are gone, once arranged by hand
  bool m_isArranged = false;                // by the user
  QFrame* m_dropMark;
  QVBoxLayout* m_column;
  QLabel* m_empty;
};

QWidget* makeRobotsDock(const RobotsContext& context, QWidget* parent);

}  // namespace pitchboard::ui
