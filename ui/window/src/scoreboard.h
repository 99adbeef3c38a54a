// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Team colours and names, score, clock and state of the game, at the right of the tool bar. UI
// thread only.

#include <QFont>
#include <QWidget>

#include <ui/base/scoreboard_state.h>

namespace pitchboard::ui {

class Scoreboard : public QWidget {
  Q_OBJECT
 public:
  explicit Scoreboard(QWidget* parent = nullptr);
  void setState(const ScoreboardState& state);
  const ScoreboardState& state() const { return m_state; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Widths {
    int name, score, clock, period, tag, gap;
    QFont names;
  };
  Widths widths() const;
  ScoreboardState m_state;
};

}  // namespace pitchboard::ui
