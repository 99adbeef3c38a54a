// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field alone on the whole screen, with the scoreboard above it: for a projector. Keys do what
// they always do; bars and docks come back as they were. UI thread only; belongs to the window.

#include <QByteArray>
#include <QObject>

#include <ui/base/beat.h>

class QAction;
class QMainWindow;

namespace pitchboard::ui {

class Scoreboard;
class ShownMoment;

class FieldOnly : public QObject {
  Q_OBJECT
 public:
  FieldOnly(QMainWindow* window, ShownMoment* shown);
  /// Checkable.
  QAction* action() const { return m_action; }
  bool isOn() const { return m_on; }
  void set(bool on);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QMainWindow* m_window;
  ShownMoment* m_shown;
  QAction* m_action;
  std::unique_ptr<Beat::Part> m_place;
  Scoreboard* m_scoreboard = nullptr;
  QByteArray m_layout;
  Qt::WindowStates m_state;
  bool m_on = false;
};

}  // namespace pitchboard::ui
