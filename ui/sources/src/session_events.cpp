// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_events.h"

namespace pitchboard::ui {

telemetry::SessionEvent sessionEventOf(const TimelineEvent& event) {
  telemetry::SessionEvent out;
  out.time = event.time;
  // Format 1 knows one kind for processes; the text tells which it was.
  const bool started = event.type == EventType::ProcessStarted;
  out.kind = started ? info(EventType::ProcessEnded).name : info(event.type).name;
  out.group = event.subject.toStdString();
  out.text = started ? (event.subject + QStringLiteral(" started")).toStdString()
                     : event.text.toStdString();
  return out;
}

TimelineEvent timelineEventOf(const telemetry::SessionEvent& event) {
  TimelineEvent out;
  out.time = event.time;
  out.type = eventTypeNamed(QString::fromStdString(event.kind));
  out.subject = QString::fromStdString(event.group);
  out.text = QString::fromStdString(event.text);
  switch (out.type) {
    case EventType::ProcessEnded:
      if (out.text.contains(QStringLiteral(" started"))) out.type = EventType::ProcessStarted;
      break;
    case EventType::Goal:
      // Whole sentences of the recorder; the mark says it shorter.
      out.subject = out.text.contains(QStringLiteral("left"))    ? QStringLiteral("left")
                    : out.text.contains(QStringLiteral("right")) ? QStringLiteral("right")
                                                                 : out.subject;
      out.text.clear();
      break;
    case EventType::Kick:
    case EventType::Fall:
    case EventType::BallOut:
      out.text.clear();
      break;
    case EventType::Warning:
      if (event.kind != info(EventType::Warning).name) {
        out.text = QString::fromStdString(event.kind + ": " + event.text);
      }
      break;
    default:
      break;
  }
  return out;
}

}  // namespace pitchboard::ui
