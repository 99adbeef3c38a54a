// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_collector.h"

#include <algorithm>

#include <ui/base/robot_words.h>
#include <ui/window/scoreboard.h>

#include "session_events.h"

namespace pitchboard::ui {
namespace {

QString nameOf(const link::MatchFrame* frame, RobotId id) {
  if (frame != nullptr) {
    if (const link::RobotFrame* robot = frame->robot(id)) return robotName(robot->identity);
  }
  return id.value > 0 ? QStringLiteral("robot %1").arg(id.value) : QString();
}

QString teamOf(const link::MatchFrame* frame, int side) {
  if (frame == nullptr) return {};
  const ScoreboardState board = scoreboardOf(*frame);
  return side == 0 ? board.leftName : board.rightName;
}

}  // namespace

QString refereeWord(const link::MatchFrame& frame) {
  if (frame.referee) return QString::fromStdString(frame.referee->state);
  if (frame.origin == link::FrameOrigin::Live) return {};
  if (frame.finished) return QStringLiteral("FINISHED");
  return frame.snapshot.clockRunning ? QStringLiteral("PLAYING") : QStringLiteral("CLOCK STOPPED");
}

EventCollector::EventCollector(FrameSource* source)
    : QObject(source), m_source(source), m_list(new EventList(this)) {
  connect(source, &FrameSource::frameReceived, this, &EventCollector::take);
  connect(source, &FrameSource::eventsReceived, this, &EventCollector::takeEvents);
  connect(source, &FrameSource::eventsRecorded, this,
          [this](const std::vector<telemetry::SessionEvent>& events) {
            std::vector<TimelineEvent> taken;
            for (const telemetry::SessionEvent& event : events) {
              // As in a match: getting up follows every fall.
              if (event.kind != "got-up" && event.kind != "unknown-action") {
                taken.push_back(timelineEventOf(event));
              }
            }
            m_list->add(std::move(taken));
          });
  connect(source, &FrameSource::restarted, this, &EventCollector::forget);
  if (const FramePtr frame = source->frame()) take(frame);
}

void EventCollector::forget() {
  m_children.clear();
  m_everRan.clear();
  m_health.clear();
  m_referee.clear();
  m_time = 0.0;
  m_list->clear();
}

void EventCollector::take(const FramePtr& frame) {
  if (!frame || frame->origin == link::FrameOrigin::Recorded) return;
  const double time = frame->snapshot.time;
  if (time < m_time) m_list->rewind(time);
  m_time = time;
  compareReferee(*frame);
  compareProcesses(*frame);
  compareHealth(*frame);
}

void EventCollector::takeEvents(const std::vector<sim::Event>& events) {
  const FramePtr frame = m_source->frame();
  const double rate = frame ? frame->tickRate : 60.0;
  std::vector<TimelineEvent> taken;
  for (const sim::Event& event : events) {
    TimelineEvent made;
    made.time = static_cast<double>(event.tick) / rate;
    made.subject = nameOf(frame.get(), event.robot);
    switch (event.kind) {
      case sim::EventKind::Goal:
        made.type = EventType::Goal;
        made.text = made.subject;
        made.subject = teamOf(frame.get(), event.value);
        break;
      case sim::EventKind::BallOut:
        made.type = EventType::BallOut;
        break;
      case sim::EventKind::Kick:
        made.type = EventType::Kick;
        break;
      case sim::EventKind::Fall:
        made.type = EventType::Fall;
        break;
      // Getting up follows every fall, and the log counts unknown codes: marks would hide more than
      // they say.
      case sim::EventKind::GotUp:
      case sim::EventKind::UnknownAction:
        continue;
    }
    taken.push_back(std::move(made));
  }
  // A few at a time: rows are inserted, and views keep their selection.
  if (taken.size() < 100) {
    for (TimelineEvent& event : taken) m_list->add(std::move(event));
  } else {
    m_list->add(std::move(taken));
  }
}

void EventCollector::compareReferee(const link::MatchFrame& frame) {
  const QString word = refereeWord(frame);
  if (word == m_referee) return;
  m_referee = word;
  if (word.isEmpty()) return;
  m_list->add({frame.snapshot.time, EventType::Referee, {}, word});
}

void EventCollector::compareHealth(const link::MatchFrame& frame) {
  for (const link::RobotFrame& heard : frame.robots) {
    if (!heard.health) continue;
    const link::RobotHealth& robot = *heard.health;
    Health& known = m_health[heard.id()];
    const QString name = robotName(heard.identity);
    if (robot.timedOut != known.timedOut) {
      m_list->add({frame.snapshot.time,
                   robot.timedOut ? EventType::Timeout : EventType::Recovery,
                   name,
                   {}});
    }
    if (robot.penalty && !known.penalised) {
      m_list->add({frame.snapshot.time, EventType::Warning, name,
                   tr("penalised: %1").arg(QString::fromStdString(robot.penalty->words))});
    }
    known = {robot.timedOut, robot.penalty.has_value()};
  }
}

void EventCollector::compareProcesses(const link::MatchFrame& frame) {
  for (const link::RobotFrame& robot : frame.robots) {
    for (const link::ChildStatus& child : robot.processes()) {
      const QString subject = QStringLiteral("%1 %2").arg(robotName(robot.identity),
                                                          QString::fromStdString(child.spec.name));
      const auto known = m_children.find(child.handle);
      const bool running = child.state == link::ChildState::Running;
      const bool ranBefore =
          known != m_children.end() && known->second.state == link::ChildState::Running;
      if (running && !ranBefore) {
        // Its first start is no event: every match begins with it.
        if (!m_everRan.emplace(child.spec.robot, child.spec.name).second) {
          m_list->add({frame.snapshot.time, EventType::ProcessStarted, subject, {}});
        }
      }
      if (child.state == link::ChildState::Failed &&
          (known == m_children.end() || known->second.state != child.state)) {
        m_list->add({frame.snapshot.time, EventType::ProcessEnded, subject,
                     QString::fromStdString(child.detail)});
      }
      m_children[child.handle] = {child.state, child.pid};
    }
  }
}

}  // namespace pitchboard::ui
