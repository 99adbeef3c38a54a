// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The time of what is shown, for everything that moves in it: the moment shown, whether that is now
// or the past, what can be looked back at, the events of the source, a chosen range. A simulated
// match and live robots go on while a person looks back; a recorded session is always looked back
// at. UI thread only.

#include <QDateTime>
#include <QObject>
#include <map>
#include <memory>
#include <optional>

#include <telemetry/series/series_store.h>
#include <ui/sources/event_list.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class EventCollector;
class Playback;
class SourceSwitch;

class Timeline : public QObject {
  Q_OBJECT
 public:
  /// The switch outlives the timeline.
  explicit Timeline(SourceSwitch* source, QObject* parent = nullptr);
  ~Timeline() override;

  /// Remembers events of this source also while another one is shown.
  void watch(FrameSource* source);
  /// Of the source that is shown; another list after sourceChanged().
  EventList* events() const;

  /// What can be shown at all: memory, or the whole recorded session.
  std::optional<telemetry::TimeRange> available() const;
  /// The newest moment of the source, whatever is shown.
  double now() const;
  /// The moment that field, cards and scoreboard show.
  double shownTime() const;
  /// The source goes on and the past is shown.
  bool isLookingBack() const;
  /// The source is a recorded session: there is no now to go to.
  bool isRecording() const;
  /// Moves in the past: of the session, or while looking back.
  Playback* playback() const;
  /// Moves while looking back, whatever the source is.
  Playback* past() const { return m_past; }
  /// Wall clock at second 0, where the source has one (Live).
  std::optional<QDateTime> clock() const;

  /// Shows this moment. At or after now in a source that goes on: back to now.
  void seek(double time);
  void goLive();
  /// One tick back or on; from now it starts to look back.
  void step(int ticks);
  /// Of the events that the filter shows. While it plays, going back again soon after an event was
  /// reached means the one before.
  bool goToNextEvent();
  bool goToPreviousEvent();
  /// At the moment shown; its row in events().
  int addBookmark(const QString& note = {});
  /// Of the bookmark at exactly this time.
  void setNote(double time, const QString& note);

  const EventFilter& eventFilter() const { return m_filter; }
  void setEventFilter(const EventFilter& filter);

  std::optional<telemetry::TimeRange> selection() const { return m_selection; }
  /// A range of less than a tick is none.
  void setSelection(std::optional<telemetry::TimeRange> range);
  bool isLooping() const { return m_looping; }
  /// Plays the chosen range over and over; without one the visible one is for the caller to choose.
  void setLooping(bool on);

 signals:
  void sourceChanged();  ///< another source or another match: read everything anew
  void moved();          ///< shownTime() or now()
  void lookingBackChanged(bool on);
  void selectionChanged();
  void eventFilterChanged();
  /// For recordings; also when a note changed.
  void bookmarked(const pitchboard::link::MatchEvent& event);

 private:
  void follow();
  void lookAt(double time);
  void show(double time);
  bool goToEvent(std::optional<int> row);
  void refresh();

  SourceSwitch* m_source;
  Playback* m_past;  // while looking back
  std::map<FrameSource*, EventCollector*> m_collectors;
  std::optional<telemetry::TimeRange> m_selection;
  EventFilter m_filter;
  std::optional<double> m_reached;  // the event gone to last, until another moment is chosen
  bool m_looping = false;
  double m_lastNow = 0.0;
};

}  // namespace pitchboard::ui
