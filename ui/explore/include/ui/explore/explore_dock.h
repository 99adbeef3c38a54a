// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Explore: starts and cancels an exploration, and shows what it found: goal
// probabilities, the time whose heat map is on the field, and the actions of a robot. UI thread
// only.

class QWidget;

namespace pitchboard::ui {

class Explorer;
class RobotSelection;
class SourceSwitch;
class Timeline;

/// Everything must outlive the dock.
struct ExploreDockParts {
  Explorer* explorer = nullptr;
  SourceSwitch* source = nullptr;
  RobotSelection* selection = nullptr;
  const Timeline* timeline = nullptr;  ///< how times are written
};
QWidget* makeExploreDock(const ExploreDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
