// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The time axis that plots and timeline share: the visible range, whether it follows the moment
// shown, and the time under the cursor. What is shown is ShownMoment's; whoever draws the axis
// follows both and nobody else. Seconds of the source. UI thread only.

#include <ui/base/beat.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

class LinkedTime : public QObject {
  Q_OBJECT
 public:
  static constexpr double minimumSpan = 1e-3;  ///< s, the shortest visible range
  /// Windows offered for following, s.
  static constexpr std::array<double, 7> windows{5, 15, 30, 60, 120, 300, 600};

  /// `shown` must outlive it.
  explicit LinkedTime(ShownMoment* shown, QObject* parent = nullptr);

  ShownMoment* shown() const { return m_shown; }
  telemetry::TimeRange range() const { return m_range; }
  double span() const { return m_range.end - m_range.begin; }
  /// Shows exactly this range and stops following. Ignores an empty or infinite range.
  void setRange(telemetry::TimeRange range);

  bool isFollowing() const { return m_following; }
  void setFollowing(bool on);
  double window() const { return m_window; }
  /// Sets the length of the range while following.
  void setWindow(double seconds);

  /// Returns the range of the rows in memory; empty while there are none.
  std::optional<telemetry::TimeRange> data() const { return m_data; }
  /// Looks for newer rows. It happens by itself ten times a second; who draws them calls it in the
  /// same beat.
  void refresh();

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
  /// Puts A and B into the visible range, or removes both.
  void showMarks(bool on);

 signals:
  void rangeChanged();
  void followingChanged(bool on);
  void windowChanged(double seconds);
  void cursorChanged();
  void playheadMoved();  ///< to, from or between chosen moments

 private:
  void put(telemetry::TimeRange range);
  void follow();
  void takeMoment();
  void noteSight();
  void leaveForeignRange();
  void rewind(double time);
  void keepInSight(double span);
  bool isInSight(double time) const { return time >= m_range.begin && time <= m_range.end; }

  ShownMoment* m_shown;
  std::unique_ptr<Beat::Part> m_refresh;
  telemetry::TimeRange m_range{0.0, 15.0};
  std::optional<telemetry::TimeRange> m_data;
  double m_window = 15.0;
  bool m_following = true;
  bool m_wasChosen = false;        // the moment, when it was last taken
  bool m_playheadInSight = false;  // before it moves
  std::optional<double> m_cursor;
};

}  // namespace pitchboard::ui
