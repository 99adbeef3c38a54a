// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the parts of the window share. UI thread.

class QSettings;

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

}  // namespace pitchboard::ui
