// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The source that the window shows: it passes on frames and signals of the chosen one, while the
// others continue unseen. It can also show a past moment of the chosen source while that continues.
// UI thread only.

#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class SourceSwitch : public FrameSource {
  Q_OBJECT
 public:
  /// All sources must outlive the switch.
  explicit SourceSwitch(FrameSource* first, QObject* parent = nullptr);

  FrameSource* current() const { return m_current; }
  /// Adds a source; the mode buttons follow.
  void add(FrameSource* source) { m_sources.push_back(source); }
  const std::vector<FrameSource*>& sources() const { return m_sources; }
  /// Returns null if there is no source of this kind.
  FrameSource* find(SourceKind kind) const;
  /// Shows this source; `restarted` and `changed` follow.
  void choose(FrameSource* source);

  SourceKind kind() const override { return m_current->kind(); }
  /// Returns the frame to show: the newest one, or a past one while looking back.
  FramePtr frame() const override { return m_past ? m_past : m_current->frame(); }
  std::shared_ptr<const telemetry::SeriesStore> series() const override {
    return m_current->series();
  }
  QString emptyText() const override { return m_current->emptyText(); }
  /// Returns the time of day at second 0; empty if times are shown from the beginning of the
  /// source.
  std::optional<QDateTime> clock() const override { return clockOf(*m_current); }
  std::optional<QDateTime> clockOf(const FrameSource& source) const {
    return m_timesOfDay ? source.clock() : std::nullopt;
  }
  /// Returns whether axes, timeline, log and readouts show times of day if the source has a clock.
  bool timesOfDay() const { return m_timesOfDay; }
  void setTimesOfDay(bool on);
  Playback* playback() const override { return m_current->playback(); }
  FramePtr frameAt(double time) const override { return m_current->frameAt(time); }

  /// Shows this moment (s of the source) until lookBack({}). Does nothing if it is not in memory.
  void lookBack(std::optional<double> time);
  std::optional<double> lookingBackAt() const { return m_pastTime; }
  /// Returns the newest frame, even while looking back.
  FramePtr newest() const { return m_current->frame(); }

 signals:
  void changed();
  /// The source has a new frame while an older moment is shown.
  void newestChanged();
  void timesOfDayChanged(bool on);

 private:
  void follow();
  void forgetPast();
  FrameSource* m_current;
  std::vector<FrameSource*> m_sources;
  FramePtr m_past;
  std::optional<double> m_pastTime;
  bool m_timesOfDay = true;
};

}  // namespace pitchboard::ui
