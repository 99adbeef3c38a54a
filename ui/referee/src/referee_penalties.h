// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of the referee's dock that penalises, warns, sends off and substitutes the robots chosen
// in its table. Every call is an undoable command. UI thread.

#include <QComboBox>
#include <QTableWidget>
#include <QWidget>
#include <functional>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/rules/referee.h>

namespace pitchboard::ui {

class MatchController;

class RefereePenalties : public QWidget {
 public:
  RefereePenalties(MatchController* match, QWidget* parent);
  /// Nothing: there is no referee.
  void show(const link::MatchFrame* frame);

 private:
  std::vector<RobotId> chosen() const;
  /// Makes `call` for every chosen robot; one step of undo.
  void callForChosen(const sim::RefereeCall& call, const QString& words);
  QTableWidgetItem* cell(int row, int column, const QString& text);

  MatchController* m_match;
  QComboBox* m_kind = nullptr;
  QTableWidget* m_robots = nullptr;
};

}  // namespace pitchboard::ui
