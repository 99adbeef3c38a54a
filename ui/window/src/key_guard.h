// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes keys mean the same wherever the focus is in a window. Text fields keep their keys; for all
// other widgets the window's shortcuts win. Space acts when it is released, unless it was held to
// pan the field; Enter presses the focused button. UI thread only.

#include <QObject>

class QAction;
class QKeyEvent;
class QMainWindow;
class QWidget;

namespace pitchboard::ui {

class FieldView;
class HelpOverlay;

class KeyGuard : public QObject {
 public:
  /// Watches the keys of the application that go to the window or to one of its floating panels.
  /// `play` is what Space triggers.
  KeyGuard(QMainWindow* window, FieldView* field, QAction* play, HelpOverlay* help);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool belongsToWindow(const QWidget& widget) const;
  bool overrides(QWidget& widget, QKeyEvent& key) const;
  bool press(QWidget& widget, QKeyEvent& key);
  bool release(const QKeyEvent& key);

  QMainWindow* m_window;
  FieldView* m_field;
  QAction* m_play;
  HelpOverlay* m_help;
  bool m_spaceDown = false;
};

}  // namespace pitchboard::ui
