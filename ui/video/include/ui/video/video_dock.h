// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The panel Video: pictures of one or several cameras at the moment that is shown, exact to the
// frame, aligned with the session, and with its field, robots and ball drawn into them. UI thread
// only; each camera decodes on a thread of its own.

#include <vector>

#include <ui/sources/film_parts.h>

class QUndoStack;
class QWidget;

namespace pitchboard::ui {

class NoteBoard;
class ReplayController;
class SessionRecording;
class ShownMoment;

/// All must outlive the dock.
struct VideoDockParts {
  ShownMoment* shown = nullptr;
  ReplayController* replay = nullptr;     ///< beside whose recording the alignment is kept
  SessionRecording* recording = nullptr;  ///< the videos go with what it records
  NoteBoard* notes = nullptr;             ///< what is drawn on pictures; may be null
};
QWidget* makeVideoDock(const VideoDockParts& parts, QWidget* parent);

/// Returns the changes of the alignment that can be undone; of the panel.
QUndoStack* videoUndoStack(QWidget* videoDock);
/// Gives up the drag that aligns a video; returns whether there was one.
bool cancelVideoDrag(QWidget* videoDock);

/// Returns the cameras that a panel shows, with their alignment, for an exported video.
std::vector<FilmCamera> filmCameras(const QWidget* videoDock);

}  // namespace pitchboard::ui
