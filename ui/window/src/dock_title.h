// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The title bar that every dock has instead of the one of the desktop. Window thread; the dock owns
// it.

#include <QWidget>

class QDockWidget;
class QHBoxLayout;

namespace pitchboard::ui {

/// Title of a dock: its name, and buttons to float and to close it, in the theme's own icons.
class DockTitle : public QWidget {
  Q_OBJECT
 public:
  explicit DockTitle(QDockWidget* dock);
  /// Folded it takes no room: the dock is one of several tabs, and the tab says its name.
  /// Says whether that is new.
  bool setFolded(bool folded);
  /// Between the name and the buttons; something else may take it away again.
  void setCorner(QWidget* corner);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool m_folded = false;
  QHBoxLayout* m_row;
};

}  // namespace pitchboard::ui
