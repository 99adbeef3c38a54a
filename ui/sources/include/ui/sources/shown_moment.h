// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the window shows: one of the sources, the newest moment of it or an earlier one, the events
// of it, a selected range, and the marks A and B. Everybody who shows something follows this object
// and nobody else: it passes on frames and signals of the source, while the other sources continue
// unseen. Earlier moments are chosen, stepped through and played here, whether they are the past of
// a source that continues meanwhile or those of a recording. Times in seconds of the source. UI
// thread only.

#include <QElapsedTimer>
#include <array>
#include <map>
#include <span>

#include <ui/sources/event_list.h>
#include <ui/sources/frame_source.h>

class QTimer;

namespace pitchboard::ui {

class EventCollector;

enum class TimeMark { A, B };
using TimeMarks = std::array<std::optional<double>, 2>;  ///< s; A, B

class ShownMoment : public FrameSource {
  Q_OBJECT
 public:
  /// All sources must outlive this object.
  explicit ShownMoment(FrameSource* first, QObject* parent = nullptr);
  ~ShownMoment() override;

  // The source.
  FrameSource* source() const { return m_source; }
  /// Adds a source, whose events are kept also while another one is shown; the mode buttons follow.
  void add(FrameSource* source);
  const std::vector<FrameSource*>& sources() const { return m_sources; }
  /// Returns null if there is no source of this kind.
  FrameSource* find(const SourceKind& kind) const;
  /// Shows this source; `restarted` and `sourceChosen` follow.
  void choose(FrameSource* source);

  const SourceKind& kind() const override { return m_source->kind(); }
  /// Returns the frame to show: the newest one, or that of the chosen moment.
  FramePtr frame() const override { return m_past ? m_past : m_source->frame(); }
  /// Returns the newest frame of the source, whatever is shown.
  FramePtr newest() const { return m_source->frame(); }
  FramePtr frameAt(double time) const override { return m_source->frameAt(time); }
  std::shared_ptr<const telemetry::SeriesStore> series() const override {
    return m_source->series();
  }
  QString emptyText() const override { return m_source->emptyText(); }
  /// Returns the range that can be shown: what is in memory, or the whole recorded session.
  std::optional<telemetry::TimeRange> available() const override { return m_source->available(); }
  /// Returns the time of day at second 0; empty if times are shown from the beginning of the
  /// source.
  std::optional<QDateTime> clock() const override { return clockOf(*m_source); }
  std::optional<QDateTime> clockOf(const FrameSource& source) const {
    return m_timesOfDay ? source.clock() : std::nullopt;
  }
  /// Returns whether axes, timeline, log and readouts show times of day if the source has a clock.
  bool timesOfDay() const { return m_timesOfDay; }
  void setTimesOfDay(bool on);

  // The moment.
  /// Returns the newest time of the source, whatever is shown.
  double now() const;
  /// Returns the time that is shown.
  double time() const { return chosenTime().value_or(now()); }
  /// Returns the time that was chosen; empty while the newest moment of the source is followed. A
  /// recording is always at a chosen time.
  std::optional<double> chosenTime() const { return m_time; }
  /// Returns whether the past of a source is shown that continues meanwhile.
  bool isLookingBack() const { return m_time && kind().hasPresent; }
  /// Shows this moment. At or after now(), follows the newest one again. Does nothing if the source
  /// does not have it in memory.
  void seek(double time);
  /// Follows the newest moment again.
  void goLive();
  /// Moves by this many ticks and pauses; starts looking back if necessary.
  void step(int ticks);
  /// Goes to the beginning of the range that is repeated or available.
  void toStart();

  // Playing chosen moments.
  static constexpr double slowest = 0.1, fastest = 16.0;
  bool isPaused() const { return m_paused; }
  /// Plays on from the chosen moment, a recording from its beginning if it is at its end. Who plays
  /// the past until it reaches the present follows that again.
  void setPaused(bool paused);
  double speed() const { return m_speed; }
  /// Limits the speed to the range from slowest to fastest.
  void setSpeed(double timesRealTime);
  static std::span<const double> speeds();
  /// Advances by this much real time, if it is not paused. Called by the timer and by tests.
  void advance(double seconds);

  // Events.
  /// Returns the events of the source; another list after `sourceChanged`.
  EventList* events() const;
  // Go to the next or previous event that passes the filter; return false if there is none. While
  // it plays, going back shortly after an event goes to the one before it.
  bool goToNextEvent();
  bool goToPreviousEvent();
  const EventFilter& filter() const { return m_filter; }
  void setFilter(const EventFilter& filter);
  /// Adds a bookmark at the moment shown and returns its row in events().
  int addBookmark(const QString& note = {});
  /// Sets the note of the bookmark at exactly this time.
  void setNote(double time, const QString& note);

  // The selected range, and the marks.
  std::optional<telemetry::TimeRange> selection() const { return m_selection; }
  /// A range of less than a millisecond clears the selection.
  void setSelection(std::optional<telemetry::TimeRange> range);
  bool isLooping() const { return m_looping; }
  /// Repeats the selection while playing.
  void setLooping(bool on);
  std::optional<double> mark(TimeMark mark) const {
    return m_marks[static_cast<std::size_t>(mark)];
  }
  void setMark(TimeMark mark, std::optional<double> time);
  const TimeMarks& marks() const { return m_marks; }
  void setMarks(const TimeMarks& marks);
  bool hasMarks() const { return m_marks[0] && m_marks[1]; }

 signals:
  /// Another source is shown.
  void sourceChosen();
  /// Another source is shown, or this one has another match or session.
  void sourceChanged();
  /// The time shown changed.
  void moved();
  /// The source has a new frame while an older moment is shown.
  void newestChanged();
  void lookingBackChanged(bool on);
  void playingChanged();  ///< paused or speed
  void timesOfDayChanged(bool on);
  void selectionChanged();
  void eventFilterChanged();
  /// A bookmark was added, or its note was changed.
  void bookmarked(const pitchboard::link::MatchEvent& bookmark);
  void marksChanged();
  /// The user moved the marks; `before` are their old positions.
  void marksMoved(const pitchboard::ui::TimeMarks& before);

 private:
  void follow();
  void begin();
  void takeFrame(const FramePtr& frame);
  void rewindTo(double time);
  void show(double time);
  void moveTo(double time);
  double tickRate() const;
  bool goToEvent(std::optional<int> row);

  FrameSource* m_source;
  std::vector<FrameSource*> m_sources;
  std::map<FrameSource*, EventCollector*> m_collectors;  // theirs
  bool m_timesOfDay = true;
  std::optional<double> m_time;  // see chosenTime()
  FramePtr m_past;               // while looking back
  double m_lastNow = 0.0;
  QTimer* m_timer;  // while it plays
  QElapsedTimer m_clock;
  bool m_paused = true;
  double m_speed = 1.0;
  EventFilter m_filter;
  std::optional<double> m_reached;  // the event gone to last, until another moment is chosen
  std::optional<telemetry::TimeRange> m_selection;
  bool m_looping = false;
  TimeMarks m_marks;
};

}  // namespace pitchboard::ui
