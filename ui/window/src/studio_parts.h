// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything the window shares out among docks, bars and menus: the list from which each of them is
// given what it uses. Only the window's room knows it whole. UI thread.

class QSettings;

namespace pitchboard::ui {

class AttachedBoards;
class AbandonedFuture;
class ComparedSessions;
class Explorer;
class FieldView;
class LinkedTime;
class LiveController;
class LiveOverlay;
class MatchController;
class NetworkShare;
class NoteBoard;
class PlotTarget;
class ReplayController;
class Rerunner;
class RobotSelection;
class RuleWatch;
class RunningWork;
class SessionFiles;
class SessionRecording;
class SituationTests;
class ShownMoment;
class TimelineActions;

/// Everything outlives what is made from it.
struct StudioParts {
  MatchController* controller = nullptr;  ///< edits and transport of the simulated match
  ShownMoment* shown = nullptr;           ///< source, moment, events: what everybody shows
  RobotSelection* selection = nullptr;
  FieldView* field = nullptr;
  LinkedTime* time = nullptr;     ///< visible range and cursor of plots and timeline
  QSettings* settings = nullptr;  ///< the user's; may be null
  PlotTarget* plots = nullptr;    ///< where variables can be sent to be plotted
  TimelineActions* timelineActions = nullptr;
  ReplayController* replay = nullptr;  ///< a recorded session
  SessionRecording* recording = nullptr;
  LiveController* live = nullptr;        ///< listens once it was asked to
  LiveOverlay* overlay = nullptr;        ///< the other source drawn beside the shown one
  ComparedSessions* compared = nullptr;  ///< sessions drawn over the shown one
  AbandonedFuture* future = nullptr;     ///< what the match has left by going on from earlier
  SituationTests* tests = nullptr;       ///< moments that are saved as tests
  AttachedBoards* boards = nullptr;      ///< blackboards of this computer
  Explorer* explorer = nullptr;          ///< what may follow the moment shown
  Rerunner* rerunner = nullptr;          ///< the recording through a process again
  RunningWork* work = nullptr;           ///< what closing the window would end
  NetworkShare* share = nullptr;         ///< what other programs see
  RuleWatch* rules = nullptr;            ///< conditions that must not hold
  SessionFiles* sessions = nullptr;      ///< opens sessions
  NoteBoard* notes = nullptr;            ///< what is drawn on field, plots and videos
};

}  // namespace pitchboard::ui
