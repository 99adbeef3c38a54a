// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_collector.h"

#include <ui/sources/match_controller.h>
#include <ui/sources/retired_match.h>

namespace pitchboard::ui {
namespace {

// Up to so many rows are inserted, and views keep their selection; more reset the list once.
constexpr std::size_t afew = 100;

}  // namespace

EventCollector::EventCollector(FrameSource* source) : QObject(source), m_list(new EventList(this)) {
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
  if (auto* match = qobject_cast<MatchController*>(source)) {
    connect(match, &MatchController::retiring, this, [this](RetiredMatch& retired) {
      retired.events.assign(m_list->events().begin(), m_list->events().end());
    });
  }
  connect(source, &FrameSource::restarted, m_list, &EventList::clear);
  connect(source, &FrameSource::rewound, m_list, &EventList::rewind);
}

}  // namespace pitchboard::ui
