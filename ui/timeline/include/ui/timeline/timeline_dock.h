// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The timeline with the button that leads back to now. UI thread only.

class QWidget;

namespace pitchboard::ui {

class AbandonedFuture;
class ComparedSession;
class LinkedTime;
class Timeline;
class TimelineActions;

/// What the dock shows and moves; everything outlives it.
struct TimelineContext {
  LinkedTime* time = nullptr;    ///< visible range and marks, those of the plots
  Timeline* timeline = nullptr;  ///< the moment shown, events, looking back
  TimelineActions* timelineActions = nullptr;
  ComparedSession* compared = nullptr;  ///< its events stand in a second row; may be null
  AbandonedFuture* future = nullptr;    ///< a pale branch; may be null
};

QWidget* makeTimelineDock(const TimelineContext& context, QWidget* parent);

}  // namespace pitchboard::ui
