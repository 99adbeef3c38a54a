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

LinkedTime::LinkedTime(ShownMoment* shown, QObject* parent) : QObject(parent), m_shown(shown) {
  constexpr Beat::Milliseconds often{100};
  m_refresh = Beat::display().add(nullptr, often, [this] { refresh(); });
  const auto refreshSoon = [this] { m_refresh->want(); };
  connect(shown, &FrameSource::frameReceived, this, refreshSoon);
  connect(shown, &ShownMoment::newestChanged, this, refreshSoon);
  connect(shown, &FrameSource::rowsAppended, this, refreshSoon);
  connect(shown, &FrameSource::rowsCame, this, &LinkedTime::refresh);
  connect(shown, &FrameSource::rewound, this, &LinkedTime::rewind);
  connect(shown, &FrameSource::restarted, this, [this] { setFollowing(true); });
  connect(shown, &ShownMoment::moved, this, &LinkedTime::takeMoment);
  connect(shown, &ShownMoment::lookingBackChanged, this, &LinkedTime::takeMoment);
  connect(shown, &ShownMoment::sourceChanged, this, [this] {
    refresh();
    takeMoment();
    leaveForeignRange();
  });
  refresh();
  takeMoment();
}

void LinkedTime::put(TimeRange range) {
  if (range == m_range) return;
  m_range = range;
  noteSight();
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

void LinkedTime::refresh() {
  m_refresh->settle();
  const auto rows = m_shown->series();
  const auto data = rows ? rows->range() : std::nullopt;
  if (data == m_data) return;
  m_data = data;
  follow();
  noteSight();
}

void LinkedTime::noteSight() {
  const auto at = playhead();
  m_playheadInSight = at && isInSight(*at);
}

void LinkedTime::rewind(double time) {
  if (m_data) {
    m_data = TimeRange{std::min(m_data->begin, time), std::min(m_data->end, time)};
    follow();
  }
  if (m_range.begin >= time) setFollowing(true);
}

/// A range that was chosen in another source may have nothing of this one.
void LinkedTime::leaveForeignRange() {
  const auto held = m_shown->available();
  if (!held || m_range.end <= held->begin || m_range.begin >= held->end) setFollowing(true);
}

void LinkedTime::follow() {
  if (!m_following) return;
  if (m_shown->chosenTime()) {
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
  const double moment = m_shown->time();
  const double share =
      isInSight(moment) ? (moment - m_range.begin) / (m_range.end - m_range.begin) : 0.5;
  double begin = span == m_range.end - m_range.begin ? m_range.begin : moment - share * span;
  begin = std::clamp(begin, moment - (1 - margin) * span, moment - margin * span);
  if (m_data) {
    const double first = std::min(m_data->begin, moment);
    const double last = std::max(m_data->end, moment);
    begin = std::clamp(begin, first, std::max(first, last - span));
  }
  put({begin, begin + span});
}

void LinkedTime::takeMoment() {
  const auto moment = m_shown->chosenTime();
  if (!moment && !std::exchange(m_wasChosen, false)) return;
  m_wasChosen = moment.has_value();
  if (m_following)
    follow();
  else if (moment && m_playheadInSight && !isInSight(*moment))
    keepInSight(span());
  noteSight();
  emit playheadMoved();
}

std::optional<double> LinkedTime::playhead() const {
  if (const auto chosen = m_shown->chosenTime()) return chosen;
  return m_data ? std::optional(m_data->end) : std::nullopt;
}

void LinkedTime::zoom(double factor, double anchor) {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  if (m_following && !m_shown->chosenTime()) {
    setWindow(m_window * factor);
    return;
  }
  const double wanted = std::clamp(span() * factor, minimumSpan, maximumSpan);
  const double share = (anchor - m_range.begin) / span();
  put({anchor - share * wanted, anchor + (1.0 - share) * wanted});
  if (!m_following) return;
  m_window = wanted;
  emit windowChanged(wanted);
  // A range that does not contain the shown moment is not moved to it.
  if (isInSight(m_shown->time())) return;
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

void LinkedTime::showMarks(bool on) {
  if (on == m_shown->hasMarks()) return;
  m_shown->setMarks(on ? TimeMarks{m_range.begin + 0.4 * span(), m_range.begin + 0.8 * span()}
                       : TimeMarks{});
}

}  // namespace pitchboard::ui
