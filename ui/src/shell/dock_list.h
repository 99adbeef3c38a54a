// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one list of docks. A dock is a pair of files with a make function, and a line in
// dock_list.cpp; menus, saved layouts and "Reset layout" follow from it.

#include <QString>
#include <Qt>
#include <span>

class QSettings;
class QWidget;

namespace pitchboard::ui {

class ComparedSession;
class FieldView;
class LinkedTime;
class LiveController;
class LiveOverlay;
class MatchController;
class PlotTarget;
class ReplayController;
class RobotSelection;
class SessionFiles;
class SessionRecording;
class SourceSwitch;
class Timeline;
class TimelineActions;

/// What a dock may use; everything outlives it.
struct StudioContext {
  MatchController* controller = nullptr;  ///< edits and transport of the simulated match
  SourceSwitch* source = nullptr;         ///< what is shown: frames, rows, events
  RobotSelection* selection = nullptr;
  FieldView* field = nullptr;
  LinkedTime* time = nullptr;     ///< visible range, cursor and marks of plots and timeline
  QSettings* settings = nullptr;  ///< the user's; may be null
  PlotTarget* plots = nullptr;    ///< where variables can be sent to be plotted
  Timeline* timeline = nullptr;   ///< the moment shown, events, looking back
  TimelineActions* timelineActions = nullptr;
  ReplayController* replay = nullptr;  ///< a recorded session
  SessionRecording* recording = nullptr;
  LiveController* live = nullptr;       ///< listens once it was asked to
  LiveOverlay* overlay = nullptr;       ///< the other source drawn beside the shown one
  ComparedSession* compared = nullptr;  ///< a second session drawn over the shown one
};

struct DockInfo {
  const char* id;  ///< in saved layouts: never change it
  const char* title;
  Qt::DockWidgetArea area;  ///< docks of the bottom are tabbed together
  bool shownAtFirst;
  int extent;  ///< width (left, right) or height (bottom) at first, mock pixels
  QWidget* (*make)(const StudioContext& context, QWidget* parent);
  bool ownRow = false;  ///< bottom: below the tabs, without a title while docked
};

std::span<const DockInfo> studioDocks();

}  // namespace pitchboard::ui
