// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The time axis that plots and timeline share: the visible range, whether it follows the newest
// data, the moment shown, the time under the cursor, and the marks A and B. Seconds of the source.
// UI thread only.

#include <QObject>
#include <array>
#include <optional>

#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

enum class TimeMark { A, B };
using TimeMarks = std::array<std::optional<double>, 2>;  ///< s; A, B

class LinkedTime : public QObject {
  Q_OBJECT
 public:
  static constexpr double minimumSpan = 1e-3;    ///< s, the shortest visible range
  static constexpr double defaultWindow = 15.0;  ///< s
  /// s; the default in Live, where robots send rarely, and in Replay.
  static constexpr double longWindow = 60.0;
  /// Windows offered for following, s.
  static constexpr std::array<double, 7> windows{5, 15, 30, 60, 120, 300, 600};

  using QObject::QObject;

  telemetry::TimeRange range() const { return m_range; }
  double span() const { return m_range.end - m_range.begin; }
  /// Shows exactly this range and stops following. Ignores an empty or infinite range.
  void setRange(telemetry::TimeRange range);

  bool isFollowing() const { return m_following; }
  void setFollowing(bool on);
  double window() const { return m_window; }
  /// Sets the length of the range while following.
  void setWindow(double seconds);

  /// Sets the range of existing data; empty while there are none. Moves the visible range while
  /// following.
  void setData(std::optional<telemetry::TimeRange> data);
  std::optional<telemetry::TimeRange> data() const { return m_data; }
  /// Called when the source continues from this earlier time. Removes later marks, and follows the
  /// source again if the visible range is entirely later.
  void rewind(double time);

  /// Sets the moment that field and cards show while looking back or in a recording; empty: they
  /// show the newest one. If the range follows, or the moment was visible, it stays visible.
  void setMoment(std::optional<double> time);
  std::optional<double> moment() const { return m_moment; }
  /// Returns the position of the playhead; empty while there are no rows.
  std::optional<double> playhead() const;
  /// Returns the time at which values are read: under the cursor, otherwise at the playhead; empty
  /// while there are no rows.
  std::optional<double> readAt() const { return m_cursor ? m_cursor : playhead(); }

  /// Zooms by `factor` (below 1: in) around `anchor`. While following the newest moment, it stays
  /// at the right edge and the window changes instead.
  void zoom(double factor, double anchor);
  void pan(double seconds);
  void fitAll();

  std::optional<double> cursor() const { return m_cursor; }
  void setCursor(std::optional<double> time);
  std::optional<double> mark(TimeMark mark) const { return m_marks[index(mark)]; }
  void setMark(TimeMark mark, std::optional<double> time);
  const TimeMarks& marks() const { return m_marks; }
  void setMarks(const TimeMarks& marks);
  bool hasMarks() const { return m_marks[0] && m_marks[1]; }
  /// Puts A and B into the visible range, or removes both.
  void showMarks(bool on);

  /// Requests that the moment at this time is shown everywhere.
  void requestMoment(double time) { emit momentRequested(time); }
  /// Requests that the newest moment is shown.
  void requestNow() { emit nowRequested(); }

 signals:
  void rangeChanged();
  void followingChanged(bool on);
  void windowChanged(double seconds);
  void cursorChanged();
  void marksChanged();
  /// The user moved the marks; `before` are their old positions.
  void marksMoved(const pitchboard::ui::TimeMarks& before);
  void momentChanged();
  void momentRequested(double time);
  void nowRequested();

 private:
  static std::size_t index(TimeMark mark) { return mark == TimeMark::A ? 0 : 1; }
  void put(telemetry::TimeRange range);
  void follow();
  void keepInSight(double span);
  bool isInSight(double time) const { return time >= m_range.begin && time <= m_range.end; }

  telemetry::TimeRange m_range{0.0, defaultWindow};
  std::optional<telemetry::TimeRange> m_data;
  double m_window = defaultWindow;
  bool m_following = true;
  std::optional<double> m_cursor, m_moment;
  TimeMarks m_marks;
};

}  // namespace pitchboard::ui
