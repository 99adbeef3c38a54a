// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/linked_time.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

void LinkedTime::rewind(double time) {
  if (m_data) setData(TimeRange{std::min(m_data->begin, time), std::min(m_data->end, time)});
  if (m_marks[0] > time || m_marks[1] > time) {
    m_marks = {};
    emit marksChanged();
  }
  if (m_range.begin >= time) setFollowing(true);
}

void LinkedTime::follow() {
  if (!m_following) return;
  if (m_moment) {
    keepInSight(m_window);
    return;
  }
  // A young source fills the window from the left instead of leaving an empty stretch before zero.
  const double newest = m_data ? m_data->end : 0.0;
  const double end = std::max(newest, (m_data ? m_data->begin : 0.0) + m_window);
  put({end - m_window, end});
}

// The moment runs towards an edge and pushes the range along from there, so that a click does not
// move what was clicked at.
void LinkedTime::keepInSight(double span) {
  constexpr double margin = 0.1;  // of the span
  const double share =
      isInSight(*m_moment) ? (*m_moment - m_range.begin) / (m_range.end - m_range.begin) : 0.5;
  double begin = span == m_range.end - m_range.begin ? m_range.begin : *m_moment - share * span;
  begin = std::clamp(begin, *m_moment - (1 - margin) * span, *m_moment - margin * span);
  if (m_data) {
    const double first = std::min(m_data->begin, *m_moment);
    const double last = std::max(m_data->end, *m_moment);
    begin = std::clamp(begin, first, std::max(first, last - span));
  }
  put({begin, begin + span});
}

void LinkedTime::setMoment(std::optional<double> time) {
  if (time && !std::isfinite(*time)) return;
  if (time == m_moment) return;
  const auto was = playhead();
  const bool seen = was && isInSight(*was);
  m_moment = time;
  if (m_following)
    follow();
  else if (time && seen && !isInSight(*time))
    keepInSight(span());
  emit momentChanged();
}

std::optional<double> LinkedTime::playhead() const {
  if (m_moment) return m_moment;
  return m_data ? std::optional(m_data->end) : std::nullopt;
}

void LinkedTime::zoom(double factor, double anchor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  if (m_following && !m_moment) {
    setWindow(m_window * factor);
    return;
  }
  const double wanted = std::clamp(span() * factor, minimumSpan, maximumSpan);
  const double share = (anchor - m_range.begin) / span();
  put({anchor - share * wanted, anchor + (1.0 - share) * wanted});
  if (!m_following) return;
  m_window = wanted;
  emit windowChanged(wanted);
  // Who looks closely at another place does not want to be pulled back to the moment shown.
  if (isInSight(*m_moment)) return;
  m_following = false;
  emit followingChanged(false);
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
  TimeMarks marks = m_marks;
  marks[index(mark)] = time;
  setMarks(marks);
}

void LinkedTime::setMarks(const TimeMarks& marks) {
  if (marks == m_marks) return;
  const TimeMarks before = std::exchange(m_marks, marks);
  emit marksChanged();
  emit marksMoved(before);
}

void LinkedTime::showMarks(bool on) {
  if (on == hasMarks()) return;
  setMarks(on ? TimeMarks{m_range.begin + 0.4 * span(), m_range.begin + 0.8 * span()}
              : TimeMarks{});
}

}  // namespace pitchboard::ui
