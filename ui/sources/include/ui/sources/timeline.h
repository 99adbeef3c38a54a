// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Navigation in the time of the source that is shown: the moment shown, whether that is now or the
// past, the available past, events, and a selected range. A simulated match and live robots
// continue while the user looks back. UI thread only.

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
  /// `source` must outlive the timeline.
  explicit Timeline(SourceSwitch* source, QObject* parent = nullptr);
  ~Timeline() override;

  /// Keeps the events of this source also while another one is shown.
  void watch(FrameSource* source);
  /// Returns the newest frame of the source that is shown; null if there is none.
  FramePtr frame() const;
  /// Returns the events of the source that is shown; another list after sourceChanged().
  EventList* events() const;

  /// Returns the range that can be shown: what is in memory, or the whole recorded session.
  std::optional<telemetry::TimeRange> available() const;
  /// Returns the newest time of the source, whatever is shown.
  double now() const;
  /// Returns the time that field, cards and scoreboard show.
  double shownTime() const;
  /// Returns whether the past of a source is shown that continues meanwhile.
  bool isLookingBack() const;
  /// Returns whether the source is a recorded session, which has no "now".
  bool isRecording() const;
  /// Returns the playback of the session, or of the past while looking back.
  Playback* playback() const;
  /// Returns the playback for looking back, whatever the source is.
  Playback* past() const { return m_past; }
  /// Returns the time of day at second 0; empty if unknown.
  std::optional<QDateTime> clock() const;

  /// Shows this moment. At or after now(), shows the newest one again.
  void seek(double time);
  void goLive();
  /// Moves by this many ticks; starts looking back if necessary.
  void step(int ticks);
  // Go to the next or previous event that passes the filter; return false if there is none. During
  // playback, going back shortly after an event goes to the one before it.
  bool goToNextEvent();
  bool goToPreviousEvent();
  /// Adds a bookmark at the moment shown and returns its row in events().
  int addBookmark(const QString& note = {});
  /// Sets the note of the bookmark at exactly this time.
  void setNote(double time, const QString& note);

  const EventFilter& filter() const { return m_filter; }
  void setFilter(const EventFilter& filter);

  std::optional<telemetry::TimeRange> selection() const { return m_selection; }
  /// A range of less than a tick clears the selection.
  void setSelection(std::optional<telemetry::TimeRange> range);
  bool isLooping() const { return m_looping; }
  /// Repeats the selected range. If there is none, the caller selects the visible one first.
  void setLooping(bool on);

 signals:
  void sourceChanged();  ///< another source or match: read everything again
  void moved();          ///< shownTime() or now()
  void lookingBackChanged(bool on);
  void selectionChanged();
  void eventFilterChanged();
  /// A bookmark was added or its note changed; recordings write it.
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
