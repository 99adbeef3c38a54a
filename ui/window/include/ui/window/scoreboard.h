// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Team colours and names, score, clock and state of the game, at the right of the tool bar: those
// of the simulated match, or what the referee says.

#include <QColor>
#include <QWidget>

#include <ui/sources/match_controller.h>

namespace pitchboard::ui {

struct ScoreboardState {
  QString leftName, rightName;     ///< BLUE; TEAM 12 where the colour is not known
  QColor leftColour, rightColour;  ///< not valid: no square
  int left = 0, right = 0;
  QString clock = QStringLiteral("00:00");
  QString state;  ///< PLAYING, PAUSED, STOPPED, FINISHED, NO REFEREE
  QString tip;    ///< more of what the referee says
  bool operator==(const ScoreboardState&) const = default;
};

/// Of a live frame: what the referee says.
ScoreboardState scoreboardOf(const link::MatchFrame& frame);

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
  ScoreboardState m_state;
};

}  // namespace pitchboard::ui
