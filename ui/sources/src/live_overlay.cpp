// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/live_overlay.h>

#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

LiveOverlay::LiveOverlay(MatchController* controller, LiveController* live, ShownMoment* shown,
                         QObject* parent)
    : QObject(parent), m_controller(controller), m_live(live), m_shown(shown) {
  // Each source's frames are drawn when the shown one has a new one; the other's in between.
  for (FrameSource* source :
       {static_cast<FrameSource*>(controller), static_cast<FrameSource*>(live)}) {
    connect(source, &FrameSource::frameReceived, this, [this, source] {
      if (m_on && source != m_shown->source()) show();
    });
    connect(source, &FrameSource::restarted, this, &LiveOverlay::show);
  }
  connect(shown, &ShownMoment::sourceChosen, this, &LiveOverlay::show);
}

void LiveOverlay::setOn(bool on) {
  if (on == m_on) return;
  m_on = on;
  if (on) m_live->start();
  show();
  emit switched(on);
}

FramePtr LiveOverlay::other() const {
  if (!m_on) return nullptr;
  if (m_shown->source() == m_controller) return m_live->frame();
  return m_shown->source() == m_live ? m_controller->frame() : nullptr;
}

void LiveOverlay::show() {
  emit otherReceived(other());
}

}  // namespace pitchboard::ui
