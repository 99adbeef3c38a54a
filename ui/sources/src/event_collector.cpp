// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_collector.h"

#include <algorithm>
#include <iterator>

#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
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
      std::ranges::remove_copy_if(m_list->events(), std::back_inserter(retired.events),
                                  isMadeByStudio);
    });
    connect(match->memory(), &MatchMemory::branching, this, [this](MatchBranch& left) {
      std::ranges::copy_if(m_list->events(), std::back_inserter(left.events),
                           [&left](const auto& event) { return event.time > left.from; });
    });
  }
  connect(source, &FrameSource::restarted, m_list, &EventList::clear);
  connect(source, &FrameSource::rewound, m_list, &EventList::rewind);
}

}  // namespace pitchboard::ui
