// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Referee panel, for every source: the state of the game, the teams with their penalties and
// cards, and the referee's calls. In Simulate it also has controls for a human referee, with the
// most likely next calls first; all calls can be undone. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class RobotSelection;
class ShownMoment;

struct RefereeContext {
  MatchController* controller;
  ShownMoment* shown;
  const RobotSelection* selection = nullptr;  ///< robots chosen on the field; may be null
};

/// All members of the context must outlive the panel.
QWidget* makeRefereePanel(const RefereeContext& context, QWidget* parent);

}  // namespace pitchboard::ui
