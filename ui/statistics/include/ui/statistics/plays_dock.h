// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Play by play: passes, shots, balls won, set plays and penalties of the match that is
// shown and of compared sessions, as a tally finds them (docs/statistics.md); each leads to its
// moment. UI thread only.

#include <functional>

class QWidget;

namespace pitchboard::ui {

class ComparedSessions;
class ReplayController;
class ShownMoment;

/// Everything must outlive the dock. The functions act on the moment or the range that is shown.
struct PlaysDockParts {
  ShownMoment* shown = nullptr;
  ReplayController* replay = nullptr;
  const ComparedSessions* compared = nullptr;
  std::function<void()> saveTest, rerun, exportRange;
};
QWidget* makePlaysDock(const PlaysDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
