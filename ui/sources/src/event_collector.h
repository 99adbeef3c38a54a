// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Keeps the events of one source in a list: those that happen while it goes on, or those of a
// recording. Belongs to the source and ends with it. UI thread only; times as in the events.

#include <ui/sources/event_list.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class EventCollector : public QObject {
  Q_OBJECT
 public:
  explicit EventCollector(FrameSource* source);
  EventList* list() const { return m_list; }

 private:
  EventList* m_list;
};

}  // namespace pitchboard::ui
