// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One team in the referee's panel: name and score, its buttons for a person who referees, and its
// players. UI thread.

#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/rules/referee.h>

namespace pitchboard::ui {

class RefereeModel;

class TeamColumn : public QWidget {
 public:
  using Call = std::function<void(const sim::RefereeCall& call, const QString& text)>;

  /// `right`: the team that defends the right goal. `called`: a button was pressed.
  TeamColumn(bool right, Call called, QWidget* parent);

  /// `refereed`: by a person in Simulate; then the buttons are there and the table is narrow.
  void show(const link::MatchFrame& frame, bool refereed);
  /// Grey, for this reason; empty: as far as calls are allowed.
  void setLocked(const link::MatchFrame* frame, const QString& why);
  /// The numbers of the chosen players.
  std::vector<int> chosen() const;
  const QTableView* table() const { return m_table; }
  /// Index of Game::teams.
  int team() const { return m_team; }

 private:
  struct Button {
    QPushButton* button;
    sim::RefereeCall call;
    QString tip;
  };
  void add(const char* name, const char* tip, const sim::RefereeCall& call);

  bool m_right;
  Call m_called;
  int m_team = 0;
  QLabel *m_square, *m_name, *m_score;
  QWidget* m_buttons;
  std::vector<Button> m_calls;
  RefereeModel* m_model;
  QTableView* m_table;
};

}  // namespace pitchboard::ui
