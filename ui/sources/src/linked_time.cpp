// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/linked_time.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::ui {
namespace {
constexpr double maximumSpan = 1e7;  // s; a season of matches
}

using telemetry::TimeRange;

void LinkedTime::put(TimeRange range) {
  if (range == m_range) return;
  m_range = range;
  emit rangeChanged();
}

void LinkedTime::setRange(TimeRange range) {
  const double span = range.end - range.begin;
  if (!std::isfinite(range.begin) || !std::isfinite(range.end) || span < minimumSpan ||
      span > maximumSpan) {
    return;
  }
  setFollowing(false);
  put(range);
}

void LinkedTime::setFollowing(bool on) {
  if (on == m_following) return;
  m_following = on;
  emit followingChanged(on);
  follow();
}

void LinkedTime::setWindow(double seconds) {
  seconds = std::clamp(seconds, minimumSpan, maximumSpan);
  if (seconds == m_window) return;
  m_window = seconds;
  emit windowChanged(seconds);
  follow();
}

void LinkedTime::setData(std::optional<TimeRange> data) {
  if (data == m_data) return;
  m_data = data;
  follow();
}

void LinkedTime::follow() {
  if (!m_following) return;
  // A young source fills the window from the left instead of leaving an empty stretch before zero.
  const double newest = m_data ? m_data->end : 0.0;
  const double end = std::max(newest, (m_data ? m_data->begin : 0.0) + m_window);
  put({end - m_window, end});
}

void LinkedTime::zoom(double factor, double anchor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  if (m_following) {
    setWindow(m_window * factor);
    return;
  }
  const double wanted = std::clamp(span() * factor, minimumSpan, maximumSpan);
  const double share = (anchor - m_range.begin) / span();
  put({anchor - share * wanted, anchor + (1.0 - share) * wanted});
}

void LinkedTime::pan(double seconds) {
  if (seconds == 0.0 || !std::isfinite(seconds)) return;
  setRange({m_range.begin + seconds, m_range.end + seconds});
}

void LinkedTime::fitAll() {
  if (!m_data) return;
  const double middle = (m_data->begin + m_data->end) / 2;
  const double half = std::max(m_data->end - m_data->begin, 2 * minimumSpan) / 2;
  setRange({middle - half, middle + half});
}

void LinkedTime::setCursor(std::optional<double> time) {
  if (time == m_cursor) return;
  m_cursor = time;
  emit cursorChanged();
}

void LinkedTime::setMark(TimeMark mark, std::optional<double> time) {
  if (time && !std::isfinite(*time)) return;
  if (m_marks[index(mark)] == time) return;
  m_marks[index(mark)] = time;
  emit marksChanged();
}

void LinkedTime::showMarks(bool on) {
  if (on == hasMarks()) return;
  if (on)
    m_marks = {m_range.begin + 0.4 * span(), m_range.begin + 0.8 * span()};
  else
    m_marks = {};
  emit marksChanged();
}

}  // namespace pitchboard::ui
