// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where events stand on the timeline: marks that would overlap become one, the most important one,
// and labels appear only where there is room. Cost: the events in view, once.

#include <QFontMetrics>
#include <QPainter>
#include <deque>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <ui/base/time_axis.h>
#include <ui/sources/event_filter.h>

namespace pitchboard::ui {

struct EventMark {
  double x = 0.0;           ///< pixel of the event that is drawn
  int row = 0;              ///< its row in the list
  int first = 0, last = 0;  ///< rows of the events that it stands for (closed)
  int merged = 1;           ///< how many of those have a mark
  QString label;            ///< elided to its room; empty without room
  bool labelLeft = false;   ///< the label stands left of the mark
};

struct MarkSizes {
  double spacing = 10.0;   ///< px between the centres of two marks at least
  double labelGap = 8.0;   ///< px from the centre to the label
  double noteRoom = 72.0;  ///< px behind a bookmark that its note has to itself at least
};

/// Marks in order of x for events in order of time.
std::vector<EventMark> layOutMarks(const std::deque<link::MatchEvent>& events, const TimeAxis& axis,
                                   const MarkSizes& sizes, const QFontMetrics& font,
                                   const EventFilter& filter = {});

/// Draws the shape around `centre`, `size` px high.
void drawMark(QPainter& painter, link::EventShape shape, QPointF centre, double size);
/// Colour of shape and stem.
QColor markColor(link::EventShape shape);

}  // namespace pitchboard::ui
