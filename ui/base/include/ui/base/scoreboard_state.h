// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a scoreboard says of a moment, in the words and colours of the screen: those of the
// simulated match, or what the referee says. Values; UI thread, for the colours of the theme.

#include <QColor>
#include <QString>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

struct ScoreboardState {
  QString leftName, rightName;     ///< ROBOFEI; BLUE without a name; TEAM 12 without a colour
  QColor leftColour, rightColour;  ///< not valid: no square
  int left = 0, right = 0;
  QString clock = QStringLiteral("00:00");
  QString state;      ///< PLAYING, PAUSED, STOPPED, FINISHED, NO REFEREE
  QString penalties;  ///< "B2 24 · R3 5": robots and seconds; empty: none
  QString tip;        ///< more of what the referee says
  bool operator==(const ScoreboardState&) const = default;
};

/// "ROBOFEI – GUESTS, " in front of other text; empty where no team has a name.
QString teamsText(const link::MatchFrame& frame);
/// Of a live frame: what the referee says.
ScoreboardState scoreboardOf(const link::MatchFrame& frame);

}  // namespace pitchboard::ui
