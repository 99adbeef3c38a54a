// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of the referee's dock that calls states, goals, timeouts and set plays, and places the
// ball. Every call is an undoable command. UI thread.

#include <QComboBox>
#include <QVBoxLayout>
#include <QWidget>
#include <functional>

#include <simcore/rules/referee.h>
#include <ui/base/number_box.h>

namespace pitchboard::ui {

class MatchController;

class RefereeGame : public QWidget {
 public:
  RefereeGame(MatchController* match, QWidget* parent);

 private:
  void addStates();
  void addTeams();
  void addSetPlays();
  void addBall();
  void call(const sim::RefereeCall& made, const QString& words);
  void placeBall(const Point& place);
  QPushButton* button(const QString& text, const QString& tip, const std::function<void()>& pressed,
                      const char* key = "");

  MatchController* m_match;
  QVBoxLayout* m_column;
  QComboBox *m_team = nullptr, *m_play = nullptr;
  NumberBox *m_x = nullptr, *m_y = nullptr;
};

}  // namespace pitchboard::ui
