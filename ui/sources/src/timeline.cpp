// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/timeline.h>

#include <algorithm>
#include <cmath>

#include <ui/sources/playback.h>
#include <ui/sources/source_switch.h>

#include "event_collector.h"

namespace pitchboard::ui {

Timeline::Timeline(SourceSwitch* source, QObject* parent)
    : QObject(parent), m_source(source), m_past(new Playback(this)) {
  connect(m_past, &Playback::positionChanged, this, &Timeline::lookAt);
  // Whoever plays the past faster than it goes on has caught up with now.
  connect(m_past, &Playback::reachedEnd, this, &Timeline::goLive);
  connect(source, &SourceSwitch::changed, this, &Timeline::follow);
  connect(source, &SourceSwitch::restarted, this, [this] {
    goLive();
    m_selection.reset();
    m_looping = false;
    emit selectionChanged();
    emit sourceChanged();
  });
  connect(source, &SourceSwitch::rewound, this, [this](double time) {
    goLive();
    m_reached.reset();
    if (m_selection && m_selection->end > time) setSelection({});
    emit moved();
  });
  connect(source, &SourceSwitch::frameReceived, this, &Timeline::refresh);
  connect(source, &SourceSwitch::newestChanged, this, &Timeline::refresh);
  connect(source, &SourceSwitch::timesOfDayChanged, this, [this] {
    for (const auto& [watched, collector] : m_collectors) collector->list()->writeTimesAnew();
    emit moved();
  });
  follow();
}

Timeline::~Timeline() = default;

void Timeline::watch(FrameSource* source) {
  if (m_collectors.contains(source)) return;
  m_collectors[source] = new EventCollector(source);
  m_collectors[source]->list()->setClock(
      [shown = m_source, source] { return shown->clockOf(*source); });
  connect(source, &QObject::destroyed, this, [this, source] { m_collectors.erase(source); });
}

void Timeline::follow() {
  watch(m_source->current());
  if (Playback* recorded = m_source->current()->playback()) {
    connect(recorded, &Playback::positionChanged, this, &Timeline::moved, Qt::UniqueConnection);
  }
  emit sourceChanged();
}

FramePtr Timeline::frame() const {
  return m_source->frame();
}

EventList* Timeline::events() const {
  return m_collectors.at(m_source->current())->list();
}

bool Timeline::isRecording() const {
  return m_source->current()->playback() != nullptr;
}

Playback* Timeline::playback() const {
  Playback* recorded = m_source->current()->playback();
  return recorded != nullptr ? recorded : m_past;
}

bool Timeline::isLookingBack() const {
  return m_source->lookingBackAt().has_value();
}

std::optional<telemetry::TimeRange> Timeline::available() const {
  if (const Playback* recorded = m_source->current()->playback()) return recorded->range();
  const auto series = m_source->series();
  return series ? series->range() : std::nullopt;
}

double Timeline::now() const {
  if (isRecording()) {
    const auto range = available();
    return range ? range->end : 0.0;
  }
  const FramePtr newest = m_source->newest();
  return newest ? newest->snapshot.time : 0.0;
}

double Timeline::shownTime() const {
  if (const Playback* recorded = m_source->current()->playback()) return recorded->position();
  return m_source->lookingBackAt().value_or(now());
}

std::optional<QDateTime> Timeline::clock() const {
  return m_source->clock();
}

void Timeline::refresh() {
  if (isLookingBack()) {
    m_past->setRange(available());
    const double oldest = m_past->range() ? m_past->range()->begin : now();
    // What was being looked at has left memory: the oldest that is still there.
    if (*m_source->lookingBackAt() < oldest) m_past->seek(oldest);
  }
  if (now() != m_lastNow) {
    m_lastNow = now();
    emit moved();
  }
}

void Timeline::lookAt(double time) {
  if (isRecording()) return;
  const bool was = isLookingBack();
  m_source->lookBack(time);
  if (isLookingBack() != was) emit lookingBackChanged(!was);
  emit moved();
}

void Timeline::seek(double time) {
  m_reached.reset();
  show(time);
}

void Timeline::show(double time) {
  if (!std::isfinite(time)) return;
  if (isRecording()) {
    playback()->seek(time);
    return;
  }
  const auto range = available();
  if (!range || time >= now()) {
    goLive();
    return;
  }
  if (const FramePtr newest = m_source->newest()) m_past->setTickRate(newest->settings->tickRate);
  m_past->setRange(range);
  const double kept = std::clamp(time, range->begin, range->end);
  m_past->seek(kept);
  if (!isLookingBack()) lookAt(kept);
}

void Timeline::goLive() {
  if (isRecording() || !isLookingBack()) return;
  m_past->setPaused(true);
  m_source->lookBack({});
  emit lookingBackChanged(false);
  emit moved();
}

void Timeline::step(int ticks) {
  if (!isRecording() && !isLookingBack()) {
    if (ticks > 0) return;
    seek(now() - 1.0 / (m_source->newest() ? m_source->newest()->settings->tickRate : 60.0));
    return;
  }
  playback()->step(ticks);
}

namespace {
// Of two events of one tick the second is a step of its own only by its time; half a tick tells
// them from the moment shown.
constexpr double sameMoment = 1e-6;
}  // namespace

bool Timeline::goToEvent(std::optional<int> row) {
  if (!row) return false;
  const double time = events()->at(*row).time;
  const auto range = available();
  // What has left memory cannot be shown any more.
  if (!range || time < range->begin - sameMoment) return false;
  show(time);
  m_reached = time;
  return true;
}

bool Timeline::goToNextEvent() {
  return goToEvent(events()->next(shownTime() + sameMoment, m_filter));
}

bool Timeline::goToPreviousEvent() {
  double from = shownTime();
  // The event that was just reached lies behind again as soon as it plays on.
  constexpr double soon = 1.5;  // s of a person's time
  const Playback* moves = playback();
  if (m_reached && !moves->isPaused() && from >= *m_reached &&
      from - *m_reached < soon * std::max(moves->speed(), 1.0)) {
    from = *m_reached;
  }
  return goToEvent(events()->previous(from - sameMoment, m_filter));
}

void Timeline::setFilter(const EventFilter& filter) {
  if (filter == m_filter) return;
  m_filter = filter;
  emit eventFilterChanged();
}

int Timeline::addBookmark(const QString& note) {
  const double time = shownTime();
  link::MatchEvent bookmark;
  bookmark.kind = link::MatchEventKind::Bookmark;
  bookmark.time = time;
  bookmark.detail = note.toStdString();
  const int row = events()->add(bookmark);
  emit bookmarked(bookmark);
  return row;
}

void Timeline::setNote(double time, const QString& note) {
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

void Timeline::setSelection(std::optional<telemetry::TimeRange> range) {
  if (range && !(range->end - range->begin > 1e-3)) range.reset();
  if (range == m_selection) return;
  m_selection = range;
  if (!range) m_looping = false;
  playback()->setLoop(m_looping ? m_selection : std::nullopt);
  emit selectionChanged();
}

void Timeline::setLooping(bool on) {
  on = on && m_selection;
  if (on == m_looping) return;
  m_looping = on;
  if (on && (shownTime() < m_selection->begin || shownTime() > m_selection->end)) {
    seek(m_selection->begin);
  }
  playback()->setLoop(on ? m_selection : std::nullopt);
  emit selectionChanged();
}

}  // namespace pitchboard::ui
