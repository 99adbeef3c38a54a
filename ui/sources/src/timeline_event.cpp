// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/timeline_event.h>

#include <QCoreApplication>

namespace pitchboard::ui {
namespace {

// In the order of EventType.
constexpr std::array<EventTypeInfo, eventTypeCount> infos{{
    {"goal", QT_TRANSLATE_NOOP("Timeline", "goal"), 9, true},
    {"kick", QT_TRANSLATE_NOOP("Timeline", "kicks the ball"), 1, false},
    {"fall", QT_TRANSLATE_NOOP("Timeline", "falls"), 4, false},
    {"ball-out", QT_TRANSLATE_NOOP("Timeline", "ball out"), 3, false},
    {"referee", QT_TRANSLATE_NOOP("Timeline", "referee"), 6, true},
    {"process", QT_TRANSLATE_NOOP("Timeline", "died"), 8, false},
    {"process-started", QT_TRANSLATE_NOOP("Timeline", "started again"), 2, false},
    {"timeout", QT_TRANSLATE_NOOP("Timeline", "not heard any more"), 7, false},
    {"recovery", QT_TRANSLATE_NOOP("Timeline", "heard again"), 2, false},
    {"warning", QT_TRANSLATE_NOOP("Timeline", "warning"), 5, false},
    {"bookmark", QT_TRANSLATE_NOOP("Timeline", "bookmark"), 10, true},
}};

QString words(EventType type) {
  return QCoreApplication::translate("Timeline", info(type).words);
}

}  // namespace

const EventTypeInfo& info(EventType type) {
  return infos[static_cast<std::size_t>(type)];
}

EventType eventTypeNamed(const QString& name) {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (name == QLatin1String(infos[i].name)) return static_cast<EventType>(i);
  }
  return EventType::Warning;
}

QString labelOf(const TimelineEvent& event) {
  if (!info(event.type).labelled) return {};
  if (event.type == EventType::Goal) {
    return QStringLiteral("%1 %2").arg(words(event.type), event.subject).trimmed();
  }
  return event.text;
}

QString sentenceOf(const TimelineEvent& event) {
  QString line = event.type == EventType::Goal && !event.subject.isEmpty()
                     ? QCoreApplication::translate("Timeline", "goal for %1").arg(event.subject)
                     : QStringLiteral("%1 %2").arg(event.subject, words(event.type)).trimmed();
  if (!event.text.isEmpty()) line += QStringLiteral(": ") + event.text;
  return line;
}

}  // namespace pitchboard::ui
