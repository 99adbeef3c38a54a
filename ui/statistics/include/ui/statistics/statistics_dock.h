// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Statistics: describes variables and expressions over a stretch of the source that is
// shown, and of the compared session, with the numbers of `pitchboard-cli statistics`. Follows the
// selected range; extremes lead to their moments. UI thread only; rows are read on a worker thread.

class QSettings;
class QWidget;

namespace pitchboard::ui {

class ComparedSessions;
class ReplayController;
class RobotSelection;
class ShownMoment;

/// All must outlive the dock.
struct StatisticsDockParts {
  ShownMoment* shown = nullptr;
  ReplayController* replay = nullptr;  ///< whose file is read while it is shown
  ComparedSessions* compared = nullptr;
  RobotSelection* selection = nullptr;
  QSettings* settings = nullptr;  ///< where the variables are kept; may be null
};
QWidget* makeStatisticsDock(const StatisticsDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
