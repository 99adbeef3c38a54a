// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The time that plots and timeline show together: the visible range, whether it follows the newest
// data or the moment shown, that moment, the one under the cursor, and the A and B marks. Seconds
// of the source. UI thread only.

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
  static constexpr double minimumSpan = 1e-3;    ///< s; less cannot be told apart on an axis
  static constexpr double defaultWindow = 15.0;  ///< s
  /// s; of robots that send less often than a match has ticks, and of what was recorded.
  static constexpr double longWindow = 60.0;
  /// Windows offered for following, s.
  static constexpr std::array<double, 7> windows{5, 15, 30, 60, 120, 300, 600};

  using QObject::QObject;

  telemetry::TimeRange range() const { return m_range; }
  double span() const { return m_range.end - m_range.begin; }
  /// Shows exactly this; ends following. An empty or infinite range is not taken.
  void setRange(telemetry::TimeRange range);

  bool isFollowing() const { return m_following; }
  void setFollowing(bool on);
  double window() const { return m_window; }
  /// Seconds shown while following.
  void setWindow(double seconds);

  /// What there is at all; nothing while there are no rows. Moves the range when following.
  void setData(std::optional<telemetry::TimeRange> data);
  std::optional<telemetry::TimeRange> data() const { return m_data; }
  /// The source goes on from this earlier moment. Marks behind it go, and a range that shows
  /// nothing before it follows the source again.
  void rewind(double time);

  /// The moment that field and cards show when it is not the newest one: while looking back, and in
  /// a recording. The visible range keeps it in sight as long as it follows, and as long as it was
  /// in sight. Nothing: the newest is shown.
  void setMoment(std::optional<double> time);
  std::optional<double> moment() const { return m_moment; }
  /// Where the line of the moment shown stands; nothing while there are no rows.
  std::optional<double> playhead() const;
  /// Where values are read: under the pointer, else at the moment shown, which is the newest one
  /// while the source goes on. Nothing while there are no rows.
  std::optional<double> readAt() const { return m_cursor ? m_cursor : playhead(); }

  /// Zooms by `factor` (< 1: closer) so that `anchor` stays where it is. While the newest moment is
  /// followed it stays at the right edge and the window changes.
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
  /// Puts A and B into the visible range, or takes both away.
  void showMarks(bool on);

  /// Asks whoever can (timeline, field) to show the field as it was at this time.
  void requestMoment(double time) { emit momentRequested(time); }
  /// The same for the newest moment of a source that goes on.
  void requestNow() { emit nowRequested(); }

 signals:
  void rangeChanged();
  void followingChanged(bool on);
  void windowChanged(double seconds);
  void cursorChanged();
  void marksChanged();
  /// Somebody moved them; before they were there.
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
