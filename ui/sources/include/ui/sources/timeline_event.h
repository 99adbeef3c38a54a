// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What can be marked on the timeline, and how each kind reads. Plain values.

#include <QString>
#include <array>
#include <cstdint>

namespace pitchboard::ui {

enum class EventType : std::uint8_t {
  Goal,
  Kick,
  Fall,
  BallOut,
  Referee,
  ProcessEnded,
  ProcessStarted,
  Timeout,
  Recovery,
  Warning,
  Bookmark
};
inline constexpr int eventTypeCount = 11;

struct TimelineEvent {
  double time = 0.0;  ///< s of the source
  EventType type = EventType::Bookmark;
  QString subject;  ///< "B1", "BLUE", "decision B2"; empty where nobody is concerned
  QString text;     ///< state of the referee, note of a bookmark, what a process left behind
  bool operator==(const TimelineEvent&) const = default;
};

struct EventTypeInfo {
  const char* name;   ///< in files and filters: never change it
  const char* words;  ///< for people
  int importance;     ///< the mark that stays where several would overlap: the highest
  bool labelled;      ///< its words stand beside the mark when there is room
};

const EventTypeInfo& info(EventType type);
/// By `EventTypeInfo::name`; Warning for a name that nobody knows.
EventType eventTypeNamed(const QString& name);
/// "goal BLUE", "PLAYING": what stands beside a mark. Empty for kinds without a label.
QString labelOf(const TimelineEvent& event);
/// "B1 kicks", "goal for BLUE": a line of a tooltip or a list.
QString sentenceOf(const TimelineEvent& event);

}  // namespace pitchboard::ui
