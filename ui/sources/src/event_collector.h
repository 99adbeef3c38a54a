// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Turns what one source says into events of the timeline: events of the simulation as they come,
// and what changes from frame to frame (referee, processes, robots that fall silent). UI thread
// only.

#include <map>
#include <set>

#include <ui/sources/event_list.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class EventCollector : public QObject {
  Q_OBJECT
 public:
  /// Belongs to the source and ends with it.
  explicit EventCollector(FrameSource* source);
  EventList* list() const { return m_list; }

 private:
  void take(const FramePtr& frame);
  void takeEvents(const std::vector<sim::Event>& events);
  void compareProcesses(const link::MatchFrame& frame);
  void compareReferee(const link::MatchFrame& frame);
  void compareHealth(const link::MatchFrame& frame);
  void forget();

  struct Child {
    link::ChildState state = link::ChildState::Running;
    pid_t pid = 0;
  };
  struct Health {
    bool timedOut = false;
    bool penalised = false;
  };
  FrameSource* m_source;
  EventList* m_list;
  std::map<int, Child> m_children;                      // by handle
  std::set<std::pair<RobotId, std::string>> m_everRan;  // robot, process
  std::map<RobotId, Health> m_health;
  QString m_referee;
  double m_time = 0.0;
};

/// "PLAYING", "CLOCK STOPPED", "FINISHED": what the scoreboard calls it, without pauses of the
/// simulation, which are none of the game's.
QString refereeWord(const link::MatchFrame& frame);

}  // namespace pitchboard::ui
