// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/playback.h>

#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>

namespace pitchboard::ui {
namespace {

constexpr std::array playbackSpeeds{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};

}  // namespace

Playback::Playback(QObject* parent) : QObject(parent), m_timer(new QTimer(this)) {
  constexpr int displayMilliseconds = 16;
  m_timer->setTimerType(Qt::PreciseTimer);
  m_timer->setInterval(displayMilliseconds);
  connect(m_timer, &QTimer::timeout, this, [this] {
    // After a suspended laptop or a blocked screen nobody wants to jump by minutes.
    constexpr double longest = 0.25;
    advance(std::min(static_cast<double>(m_clock.nsecsElapsed()) * 1e-9, longest));
    m_clock.start();
  });
}

std::span<const double> Playback::speeds() const {
  return playbackSpeeds;
}

void Playback::setRange(std::optional<telemetry::TimeRange> range) {
  if (range && !(range->begin <= range->end)) range.reset();
  if (range == m_range) return;
  const bool cameOrWent = range.has_value() != m_range.has_value();
  m_range = range;
  if (!m_range)
    setPaused(true);
  else if (m_position < m_range->begin || m_position > m_range->end)
    move(m_position);
  if (cameOrWent) emit changed();
}

void Playback::move(double time) {
  if (m_range) time = std::clamp(time, m_range->begin, m_range->end);
  if (time == m_position || !std::isfinite(time)) return;
  m_position = time;
  emit positionChanged(time);
}

void Playback::seek(double time) {
  move(time);
}

void Playback::setLoop(std::optional<telemetry::TimeRange> loop) {
  if (loop && !(loop->begin < loop->end)) loop.reset();
  if (loop == m_loop) return;
  m_loop = loop;
  emit changed();
}

void Playback::setTickRate(double perSecond) {
  if (perSecond > 0 && std::isfinite(perSecond)) m_tickRate = perSecond;
}

void Playback::setPaused(bool paused) {
  if (paused == m_paused || (!paused && !m_range)) return;
  m_paused = paused;
  if (paused) {
    m_timer->stop();
  } else {
    if (m_position >= m_range->end && !m_loop) move(m_range->begin);
    m_clock.start();
    m_timer->start();
  }
  emit changed();
}

void Playback::step(int ticks) {
  setPaused(true);
  // From tick to tick, whatever lies between: the time of a tick is a multiple of its length.
  move((std::round(m_position * m_tickRate) + ticks) / m_tickRate);
}

void Playback::toStart() {
  if (m_loop)
    move(m_loop->begin);
  else if (m_range)
    move(m_range->begin);
}

void Playback::setSpeed(double timesRealTime) {
  if (!std::isfinite(timesRealTime)) return;
  const double speed = std::clamp(timesRealTime, slowest, fastest);
  if (speed == m_speed) return;
  m_speed = speed;
  emit changed();
}

void Playback::advance(double seconds) {
  if (m_paused || !m_range) return;
  double next = m_position + seconds * m_speed;
  if (m_loop) {
    const double begin = std::max(m_loop->begin, m_range->begin);
    const double end = std::min(m_loop->end, m_range->end);
    if (end > begin && (next >= end || next < begin)) {
      next = next < begin ? begin : begin + std::fmod(next - end, end - begin);
    }
  }
  move(next);
  if (!m_loop && m_range && m_position >= m_range->end && !m_paused) {
    setPaused(true);
    emit reachedEnd();
  }
}

}  // namespace pitchboard::ui
