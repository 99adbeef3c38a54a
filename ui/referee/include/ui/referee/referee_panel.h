// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee, whatever is shown: the state of the game, the teams with their penalties and cards,
// and what the referee said. In Simulate also the controls of a person who referees, arranged by
// what happens next; every call can be undone. UI thread only.

class QWidget;

namespace pitchboard::ui {

class MatchController;
class RobotSelection;
class SourceSwitch;
class Timeline;

struct RefereeContext {
  MatchController* controller;
  const SourceSwitch* source;
  Timeline* timeline;
  const RobotSelection* selection = nullptr;  ///< robots chosen on the field; may be null
};

/// What the context names must outlive the panel.
QWidget* makeRefereePanel(const RefereeContext& context, QWidget* parent);

}  // namespace pitchboard::ui
