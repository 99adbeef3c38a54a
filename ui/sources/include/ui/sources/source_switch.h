// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The source that the window shows at the moment: passes on what the chosen one says. The others
// go on running unseen. It can also show a past moment of the chosen one, which goes on unseen
// then.

#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class SourceSwitch : public FrameSource {
  Q_OBJECT
 public:
  /// Sources outlive the switch.
  explicit SourceSwitch(FrameSource* first, QObject* parent = nullptr);

  FrameSource* current() const { return m_current; }
  /// Offers a further source; the mode buttons follow.
  void add(FrameSource* source) { m_sources.push_back(source); }
  const std::vector<FrameSource*>& sources() const { return m_sources; }
  /// The source of this kind, or nullptr.
  FrameSource* find(SourceKind kind) const;
  /// Shows this source from now on; `restarted` and `changed` follow.
  void choose(FrameSource* source);

  SourceKind kind() const override { return m_current->kind(); }
  /// What is to be shown: the newest frame, or the past one while looking back.
  FramePtr frame() const override { return m_past ? m_past : m_current->frame(); }
  std::shared_ptr<const telemetry::SeriesStore> series() const override {
    return m_current->series();
  }
  QString emptyText() const override { return m_current->emptyText(); }
  /// As times are to be written: nothing where they count from the source's beginning.
  std::optional<QDateTime> clock() const override { return clockOf(*m_current); }
  std::optional<QDateTime> clockOf(const FrameSource& source) const {
    return m_timesOfDay ? source.clock() : std::nullopt;
  }
  /// Times as time of day where the source has one, or from its beginning: two ways to write one
  /// time, the same for axes, timeline, log and readouts.
  bool timesOfDay() const { return m_timesOfDay; }
  void setTimesOfDay(bool on);
  Playback* playback() const override { return m_current->playback(); }
  FramePtr frameAt(double time) const override { return m_current->frameAt(time); }

  /// Shows this moment (s of the source) from memory until lookBack({}); a moment that memory does
  /// not hold changes nothing.
  void lookBack(std::optional<double> time);
  std::optional<double> lookingBackAt() const { return m_pastTime; }
  /// The newest frame, also while looking back.
  FramePtr newest() const { return m_current->frame(); }

 signals:
  void changed();
  /// The source goes on while an older moment is shown.
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
