// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Timeline dock, with the button that returns to now. UI thread only.

class QWidget;

namespace pitchboard::ui {

class AbandonedFuture;
class ComparedSessions;
class LinkedTime;
class RuleWatch;
class ShownMoment;
class TimelineActions;

/// What the dock shows and changes; all must outlive it.
struct TimelineContext {
  LinkedTime* time = nullptr;    ///< visible range and cursor, shared with the plots
  ShownMoment* shown = nullptr;  ///< the moment shown, events, looking back
  TimelineActions* timelineActions = nullptr;
  ComparedSessions* compared = nullptr;  ///< a row each; may be null
  AbandonedFuture* future = nullptr;     ///< shown as a second branch; may be null
  RuleWatch* rules = nullptr;            ///< shown in a row of their own; may be null
};

QWidget* makeTimelineDock(const TimelineContext& context, QWidget* parent);

}  // namespace pitchboard::ui
