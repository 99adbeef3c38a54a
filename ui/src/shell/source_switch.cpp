// SPDX-License-Identifier: GPL-3.0-or-later
#include "source_switch.h"

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
  follow();
  emit restarted();
  emit changed();
  if (const FramePtr newest = frame()) emit frameReceived(newest);
}

void SourceSwitch::follow() {
  connect(m_current, &FrameSource::frameReceived, this, &FrameSource::frameReceived);
  connect(m_current, &FrameSource::eventsReceived, this, &FrameSource::eventsReceived);
  connect(m_current, &FrameSource::logReceived, this, &FrameSource::logReceived);
  connect(m_current, &FrameSource::restarted, this, &FrameSource::restarted);
}

}  // namespace pitchboard::ui
