// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Explore: starts and cancels an exploration, and shows what it found: goal
// probabilities, and the time whose heat map is on the field. UI thread only.

class QWidget;

namespace pitchboard::ui {

class Explorer;
class ShownMoment;

/// Everything must outlive the dock.
struct ExploreDockParts {
  Explorer* explorer = nullptr;
  ShownMoment* shown = nullptr;
};
QWidget* makeExploreDock(const ExploreDockParts& parts, QWidget* parent);

}  // namespace pitchboard::ui
