// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/abandoned_future.h>

#include <utility>

#include <ui/base/robot_text.h>
#include <ui/sources/event_list.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

AbandonedFuture::AbandonedFuture(MatchController* match, ShownMoment* shown, QObject* parent)
    : QObject(parent), m_match(match), m_shown(shown), m_events(new EventList(this)) {
  connect(match->memory(), &MatchMemory::branched, this, [this](const MatchBranch& left) {
    const auto range = left.rows->range();
    if (!range || range->end <= left.from) return;
    m_left = left;
    m_end = range->end;
    m_events->clear();
    m_events->add(std::exchange(m_left.events, {}));
    m_frames.reset();
    emit changed();
    emit began();
    showMoment();
  });
  connect(match, &FrameSource::restarted, this, &AbandonedFuture::drop);
  connect(match, &FrameSource::frameReceived, this, &AbandonedFuture::keepBudget);
  connect(shown, &ShownMoment::sourceChosen, this, [this] {
    emit changed();
    showMoment();
  });
  connect(shown, &ShownMoment::moved, this, &AbandonedFuture::showMoment);
}

bool AbandonedFuture::isOn() const {
  return m_left.rows && m_shown->source() == m_match;
}

std::shared_ptr<const telemetry::SeriesStore> AbandonedFuture::series() const {
  return isOn() ? m_left.rows : nullptr;
}

QString AbandonedFuture::caption() const {
  return QStringLiteral("abandoned at %1").arg(clockText(begin()));
}

void AbandonedFuture::setCompared(bool on) {
  if (on == m_compared || !m_left.rows) return;
  m_compared = on;
  if (!on) emit momentReached(nullptr);
  showMoment();
  emit changed();
}

void AbandonedFuture::drop() {
  if (!m_left.rows) return;
  setCompared(false);
  m_left = {};
  m_events->clear();
  m_frames.reset();
  emit changed();
}

// The match itself goes first.
void AbandonedFuture::keepBudget() {
  if (!m_left.rows) return;
  const auto rows = m_match->series();
  if (rows && rows->memoryBytes() + m_left.bytes > m_match->memory()->memoryBudget()) drop();
}

void AbandonedFuture::showMoment() {
  if (!m_compared) return;
  const FramePtr now = m_match->frame();
  const double time = m_shown->time();
  if (!isOn() || !now || time < m_left.from || time > m_end) {
    emit momentReached(nullptr);
    return;
  }
  if (!m_frames) m_frames = std::make_unique<link::RecordedFrames>(*now->settings);
  emit momentReached(std::make_shared<link::MatchFrame>(m_frames->frameAt(*m_left.rows, time)));
}

}  // namespace pitchboard::ui
