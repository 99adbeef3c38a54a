// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Actions of the timeline, for the menu bar and its context menu. The window's key map assigns
// their keys. UI thread only.

#include <QObject>
#include <QPoint>
#include <array>
#include <functional>

class QAction;
class QMenu;

namespace pitchboard::ui {

class AbandonedFuture;
struct EventFilter;
class LinkedTime;
class ShownMoment;

class TimelineActions : public QObject {
  Q_OBJECT
 public:
  /// `plots` and `future` may be null.
  TimelineActions(ShownMoment* shown, LinkedTime* plots, AbandonedFuture* future, QObject* parent);
  void fill(QMenu* menu);

  QAction* next() const { return m_next; }
  QAction* previous() const { return m_previous; }
  QAction* bookmark() const { return m_bookmark; }
  QAction* loop() const { return m_loop; }

 signals:
  /// A bookmark was added; its note can be edited.
  void bookmarkAdded(int row);

 private:
  void refresh();
  /// Asks for a time and shows that moment. What was `typed` before, and why it was refused.
  void askForTime(const QString& typed = {}, const QString& problem = {});
  void fillFilter(QMenu* menu);
  void change(const std::function<void(EventFilter&)>& how);

  ShownMoment* m_shown;
  LinkedTime* m_plots;
  QAction* m_now;
  QAction* m_oldest;
  QAction* m_goTo;
  QAction* m_next;
  QAction* m_previous;
  QAction* m_bookmark;
  std::array<QAction*, 4> m_steps;  // a tick back, forward; a second
  QAction* m_selectVisible;
  QAction* m_clearRange;
  QAction* m_loop;
  QAction* m_compareFuture;
  QAction* m_dropFuture;
};

}  // namespace pitchboard::ui
