// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Gives a widget of a dock the free end of the row of tabs in which the dock stands, so that tabs
// inside of it need no row of their own; beside the title while the dock stands alone, and back in
// the dock where there is neither. UI thread only; the dock owns it.

#include <QObject>
#include <QPointer>
#include <vector>

class QDockWidget;
class QTabBar;
class QWidget;

namespace pitchboard::ui {

class TabCorner : public QObject {
  Q_OBJECT
 public:
  /// `corner` is in the layout of the dock's widget, where it goes back to; `docks` are all that
  /// can share the row.
  TabCorner(QDockWidget* dock, QWidget* corner, const std::vector<QDockWidget*>& docks);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();
  /// The row of tabs of the main window that has the dock, seen or not; null: there is none.
  QTabBar* row() const;
  void goInto(QTabBar* row);
  void goHome();

  QDockWidget* m_dock;
  QPointer<QWidget> m_corner;
  QPointer<QTabBar> m_row;
};

}  // namespace pitchboard::ui
