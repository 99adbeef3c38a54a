// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a scoreboard shows for a frame, of the simulated match or of the referee's packets. Plain
// values with colours of the theme; UI thread only.

#include <QColor>
#include <QFontMetricsF>
#include <QString>
#include <QStringList>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

struct ScoreboardState {
  QString leftName, rightName;     ///< ROBOFEI; without a name BLUE, without a colour TEAM 12
  QColor leftColour, rightColour;  ///< invalid: no coloured square
  int left = 0, right = 0;
  QString clock = QStringLiteral("00:00");  ///< minutes and seconds, also beyond an hour
  QString period;       ///< with a referee: 1st, 2nd, ET 1, ET 2, PEN; empty: unknown
  QString state;        ///< PLAYING, PAUSED, STOPPED, FINISHED, NO REFEREE
  QStringList shorter;  ///< the state with less and less beside it, for little room
  QString penalties;    ///< robots and seconds, such as "B2 24 · R3 5"; empty: none
  QString tip;          ///< tool tip with further data of the referee
  bool operator==(const ScoreboardState&) const = default;
};

/// Returns the longest form of the state that fits into `width` px, elided if none does.
QString stateText(const ScoreboardState& board, const QFontMetricsF& metrics, double width);

/// Returns "ROBOFEI – GUESTS, " to put before other text; empty if no team has a name.
QString teamsText(const link::MatchFrame& frame);
/// Makes the state of a frame; for a live frame, from the referee's packets.
ScoreboardState scoreboardOf(const link::MatchFrame& frame);

}  // namespace pitchboard::ui
