// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/shown_moment.h>

#include <QTimer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "event_collector.h"

namespace pitchboard::ui {

using telemetry::TimeRange;

ShownMoment::ShownMoment(FrameSource* first, QObject* parent)
    : FrameSource(parent), m_source(first), m_timer(new QTimer(this)) {
  constexpr int displayMilliseconds = 16;
  m_timer->setTimerType(Qt::PreciseTimer);
  m_timer->setInterval(displayMilliseconds);
  connect(m_timer, &QTimer::timeout, this, [this] {
    // After a suspended laptop or a blocked screen nobody wants to jump by minutes.
    constexpr double longest = 0.25;
    advance(std::min(static_cast<double>(m_clock.nsecsElapsed()) * 1e-9, longest));
    m_clock.start();
  });
  add(first);
  follow();
  if (!kind().hasPresent) m_time = first->standsAt();
}

ShownMoment::~ShownMoment() = default;

void ShownMoment::add(FrameSource* source) {
  if (m_collectors.contains(source)) return;
  m_sources.push_back(source);
  auto* collector = m_collectors[source] = new EventCollector(source);
  collector->list()->setClock([this, source] { return clockOf(*source); });
}

FrameSource* ShownMoment::find(const SourceKind& kind) const {
  const auto found = std::ranges::find_if(
      m_sources, [&kind](const FrameSource* source) { return source->kind() == kind; });
  return found != m_sources.end() ? *found : nullptr;
}

void ShownMoment::choose(FrameSource* source) {
  if (source == m_source) return;
  m_source->disconnect(this);
  m_source = source;
  add(source);
  follow();
  begin();
  emit sourceChosen();
  if (const FramePtr newest = frame()) emit frameReceived(newest);
}

void ShownMoment::follow() {
  connect(m_source, &FrameSource::frameReceived, this, &ShownMoment::takeFrame);
  connect(m_source, &FrameSource::eventsReceived, this, &FrameSource::eventsReceived);
  connect(m_source, &FrameSource::eventsRecorded, this, &FrameSource::eventsRecorded);
  connect(m_source, &FrameSource::logReceived, this, &FrameSource::logReceived);
  connect(m_source, &FrameSource::rowsCame, this, &FrameSource::rowsCame);
  connect(m_source, &FrameSource::rowsAppended, this, &FrameSource::rowsAppended);
  connect(m_source, &FrameSource::rewound, this, &ShownMoment::rewindTo);
  connect(m_source, &FrameSource::restarted, this, &ShownMoment::begin);
}

/// There is another match or session, whose moments have nothing to do with those before.
void ShownMoment::begin() {
  setPaused(true);
  m_past.reset();
  m_time = kind().hasPresent ? std::nullopt : std::optional(m_source->standsAt());
  m_reached.reset();
  m_selection.reset();
  m_looping = false;
  emit selectionChanged();
  emit sourceChanged();
  emit restarted();
}

void ShownMoment::takeFrame(const FramePtr& frame) {
  if (isLookingBack()) {
    // What was being looked at has left memory: the oldest that is still there.
    if (const auto range = available(); range && *m_time < range->begin) moveTo(range->begin);
    emit newestChanged();
    return;
  }
  if (std::exchange(m_lastNow, now()) != now()) emit moved();
  emit frameReceived(frame);
}

void ShownMoment::rewindTo(double time) {
  goLive();
  m_reached.reset();
  if (m_selection && m_selection->end > time) setSelection({});
  if (m_marks[0] > time || m_marks[1] > time) {
    m_marks = {};
    emit marksChanged();
  }
  emit moved();
  emit rewound(time);
}

void ShownMoment::setTimesOfDay(bool on) {
  if (on == m_timesOfDay) return;
  m_timesOfDay = on;
  for (const auto& [source, collector] : m_collectors) collector->list()->writeTimesAnew();
  emit timesOfDayChanged(on);
  emit moved();
}

double ShownMoment::now() const {
  if (!kind().hasPresent) {
    const auto range = available();
    return range ? range->end : 0.0;
  }
  const FramePtr newest = m_source->frame();
  return newest ? newest->snapshot.time : 0.0;
}

double ShownMoment::tickRate() const {
  const FramePtr newest = m_source->frame();
  return newest ? newest->settings->tickRate : 60.0;
}

void ShownMoment::seek(double time) {
  m_reached.reset();
  show(time);
}

void ShownMoment::show(double time) {
  if (!std::isfinite(time)) return;
  if (kind().hasPresent && (!available() || time >= now()))
    goLive();
  else
    moveTo(time);
}

void ShownMoment::moveTo(double time) {
  const auto range = available();
  if (!range) return;
  time = std::clamp(time, range->begin, range->end);
  if (m_time == time) return;
  if (!kind().hasPresent) {
    m_time = time;
    m_source->standAt(time);
    emit moved();
    return;
  }
  FramePtr past = kind().hasPast ? m_source->frameAt(time) : nullptr;
  if (!past) return;
  const bool wasLookingBack = isLookingBack();
  m_past = std::move(past);
  m_time = time;
  emit frameReceived(m_past);
  if (!wasLookingBack) emit lookingBackChanged(true);
  emit moved();
}

void ShownMoment::goLive() {
  if (!isLookingBack()) return;
  setPaused(true);
  m_past.reset();
  m_time.reset();
  if (const FramePtr newest = m_source->frame()) emit frameReceived(newest);
  emit lookingBackChanged(false);
  emit moved();
}

// From tick to tick, whatever lies between: the time of a tick is a multiple of its length.
void ShownMoment::step(int ticks) {
  const double rate = tickRate();
  if (!m_time) {
    if (ticks < 0) seek(now() - 1.0 / rate);
    return;
  }
  setPaused(true);
  moveTo((std::round(*m_time * rate) + ticks) / rate);
}

void ShownMoment::toStart() {
  if (m_looping)
    moveTo(m_selection->begin);
  else if (const auto range = available())
    moveTo(range->begin);
}

std::span<const double> ShownMoment::speeds() {
  static constexpr std::array offered{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  return offered;
}

void ShownMoment::setPaused(bool paused) {
  const auto range = available();
  if (paused == m_paused || (!paused && (!m_time || !range))) return;
  m_paused = paused;
  if (paused) {
    m_timer->stop();
  } else {
    if (*m_time >= range->end && !m_looping) moveTo(range->begin);
    m_clock.start();
    m_timer->start();
  }
  emit playingChanged();
}

void ShownMoment::setSpeed(double timesRealTime) {
  if (!std::isfinite(timesRealTime)) return;
  const double speed = std::clamp(timesRealTime, slowest, fastest);
  if (std::exchange(m_speed, speed) != speed) emit playingChanged();
}

void ShownMoment::advance(double seconds) {
  const auto range = available();
  if (m_paused || !m_time || !range) return;
  double next = *m_time + seconds * m_speed;
  if (m_looping) {
    const double begin = std::max(m_selection->begin, range->begin);
    const double end = std::min(m_selection->end, range->end);
    if (end > begin && (next >= end || next < begin)) {
      next = next < begin ? begin : begin + std::fmod(next - end, end - begin);
    }
  }
  moveTo(next);
  if (m_paused || m_looping || !m_time || *m_time < range->end) return;
  setPaused(true);
  // Playing the past faster than real time catches up with the present.
  goLive();
}

EventList* ShownMoment::events() const {
  return m_collectors.at(m_source)->list();
}

namespace {
// Of two events of one tick the second is a step of its own only by its time; half a tick tells
// them from the moment shown.
constexpr double sameMoment = 1e-6;
}  // namespace

bool ShownMoment::goToEvent(std::optional<int> row) {
  if (!row) return false;
  const double time = events()->at(*row).time;
  const auto range = available();
  // What has left memory cannot be shown any more.
  if (!range || time < range->begin - sameMoment) return false;
  show(time);
  m_reached = time;
  return true;
}

bool ShownMoment::goToNextEvent() {
  return goToEvent(events()->next(this->time() + sameMoment, m_filter));
}

bool ShownMoment::goToPreviousEvent() {
  double from = this->time();
  // The event that was just reached lies behind again as soon as it plays on.
  constexpr double soon = 1.5;  // s of a person's time
  if (m_reached && !m_paused && from >= *m_reached &&
      from - *m_reached < soon * std::max(m_speed, 1.0)) {
    from = *m_reached;
  }
  return goToEvent(events()->previous(from - sameMoment, m_filter));
}

void ShownMoment::setFilter(const EventFilter& filter) {
  if (filter == m_filter) return;
  m_filter = filter;
  emit eventFilterChanged();
}

int ShownMoment::addBookmark(const QString& note) {
  const double time = this->time();
  link::MatchEvent bookmark;
  bookmark.kind = link::MatchEventKind::Bookmark;
  bookmark.time = time;
  bookmark.detail = note.toStdString();
  const int row = events()->add(bookmark);
  emit bookmarked(bookmark);
  return row;
}

void ShownMoment::setNote(double time, const QString& note) {
  EventList* list = events();
  for (int row = list->previous(time).value_or(-1) + 1;
       row < list->rowCount() && list->at(row).time <= time; ++row) {
    const link::MatchEvent& event = list->at(row);
    if (event.kind != link::MatchEventKind::Bookmark || event.time != time) continue;
    if (event.detail == note.toStdString()) continue;
    list->setNote(row, note);
    emit bookmarked(list->at(row));
    return;
  }
}

void ShownMoment::setSelection(std::optional<TimeRange> range) {
  if (range && !(range->end - range->begin > 1e-3)) range.reset();
  if (range == m_selection) return;
  m_selection = range;
  if (!range) m_looping = false;
  emit selectionChanged();
}

void ShownMoment::setLooping(bool on) {
  on = on && m_selection;
  if (on == m_looping) return;
  m_looping = on;
  if (on && (time() < m_selection->begin || time() > m_selection->end)) seek(m_selection->begin);
  emit selectionChanged();
}

void ShownMoment::setMark(TimeMark mark, std::optional<double> time) {
  if (time && !std::isfinite(*time)) return;
  TimeMarks marks = m_marks;
  marks[static_cast<std::size_t>(mark)] = time;
  setMarks(marks);
}

void ShownMoment::setMarks(const TimeMarks& marks) {
  if (marks == m_marks) return;
  const TimeMarks before = std::exchange(m_marks, marks);
  emit marksChanged();
  emit marksMoved(before);
}

}  // namespace pitchboard::ui
