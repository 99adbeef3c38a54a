// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is seldom needed while a match is refereed: rules, who calls, formations, the ball. Folded
// away at first. UI thread.

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QToolButton>
#include <QWidget>

#include <robotlink/frame/match_frame.h>
#include <ui/base/number_box.h>

namespace pitchboard::ui {

class MatchController;

class RulesFold : public QWidget {
 public:
  RulesFold(MatchController* match, QWidget* parent);
  /// `shown`: what the panel shows; null: no match. `why`: the controls are grey; empty: they work.
  void show(const link::MatchFrame* shown, const QString& why);

 private:
  void addRules();
  void addFormations();
  void addBall();
  void loadFormation(bool left);
  void placeBall(Point place);

  MatchController* m_match;
  bool m_refereed = true;
  QToolButton* m_fold;
  QWidget* m_inside;
  QComboBox *m_rules = nullptr, *m_formation = nullptr;
  QCheckBox *m_automatic = nullptr, *m_asSetPlay = nullptr;
  QLabel* m_staysOff = nullptr;
  NumberBox *m_x = nullptr, *m_y = nullptr;
};

}  // namespace pitchboard::ui
