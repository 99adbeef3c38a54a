// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/source_switch.h>

namespace pitchboard::ui {

SourceSwitch::SourceSwitch(FrameSource* first, QObject* parent)
    : FrameSource(parent), m_current(first), m_sources{first} {
  follow();
}

FrameSource* SourceSwitch::find(SourceKind kind) const {
  for (FrameSource* source : m_sources) {
    if (source->kind() == kind) return source;
  }
  return nullptr;
}

void SourceSwitch::choose(FrameSource* source) {
  if (source == m_current) return;
  m_current->disconnect(this);
  m_current = source;
  forgetPast();
  follow();
  emit restarted();
  emit changed();
  if (const FramePtr newest = frame()) emit frameReceived(newest);
}

void SourceSwitch::follow() {
  connect(m_current, &FrameSource::robotsRenamed, this, &FrameSource::robotsRenamed);
  connect(m_current, &FrameSource::frameReceived, this, [this](const FramePtr& frame) {
    if (m_past)
      emit newestChanged();
    else
      emit frameReceived(frame);
  });
  connect(m_current, &FrameSource::eventsReceived, this, &FrameSource::eventsReceived);
  connect(m_current, &FrameSource::eventsRecorded, this, &FrameSource::eventsRecorded);
  connect(m_current, &FrameSource::logReceived, this, &FrameSource::logReceived);
  connect(m_current, &FrameSource::rowsCame, this, &FrameSource::rowsCame);
  connect(m_current, &FrameSource::rewound, this, &FrameSource::rewound);
  connect(m_current, &FrameSource::restarted, this, [this] {
    forgetPast();
    emit restarted();
  });
}

void SourceSwitch::setTimesOfDay(bool on) {
  if (on == m_timesOfDay) return;
  m_timesOfDay = on;
  emit timesOfDayChanged(on);
}

void SourceSwitch::forgetPast() {
  m_past.reset();
  m_pastTime.reset();
}

void SourceSwitch::lookBack(std::optional<double> time) {
  if (!time) {
    if (!m_past) return;
    forgetPast();
    if (const FramePtr newest = frame()) emit frameReceived(newest);
    return;
  }
  FramePtr past = m_current->frameAt(*time);
  if (!past) return;
  m_past = std::move(past);
  m_pastTime = time;
  emit frameReceived(m_past);
}

}  // namespace pitchboard::ui
