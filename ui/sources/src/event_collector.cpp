// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_collector.h"

namespace pitchboard::ui {
namespace {

// Up to so many rows are inserted, and views keep their selection; more reset the list once.
constexpr std::size_t afew = 100;

}  // namespace

EventCollector::EventCollector(FrameSource* source) : QObject(source), m_list(new EventList(this)) {
  connect(source, &FrameSource::frameReceived, this, &EventCollector::follow);
  connect(source, &FrameSource::eventsReceived, this,
          [this](const std::vector<link::MatchEvent>& events) {
            if (events.size() >= afew) {
              m_list->add(events);
            } else {
              for (const link::MatchEvent& event : events) m_list->add(event);
            }
          });
  connect(source, &FrameSource::eventsRecorded, this,
          [this](const std::vector<link::MatchEvent>& events) { m_list->add(events); });
  connect(source, &FrameSource::restarted, this, [this] {
    m_time = 0.0;
    m_list->clear();
  });
  if (const FramePtr frame = source->frame()) follow(frame);
}

// A source that was put back: what came behind that moment has not happened.
void EventCollector::follow(const FramePtr& frame) {
  if (!frame || frame->origin == link::FrameOrigin::Recorded) return;
  const double time = frame->snapshot.time;
  if (time < m_time) m_list->rewind(time);
  m_time = time;
}

}  // namespace pitchboard::ui
