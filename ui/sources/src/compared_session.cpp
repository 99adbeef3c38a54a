// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/compared_session.h>

#include <QFileInfo>

#include <ui/sources/shown_moment.h>

#include "event_collector.h"

namespace pitchboard::ui {

ComparedSession::ComparedSession(ShownMoment* shown, QObject* parent)
    : QObject(parent), m_shown(shown), m_events(new EventCollector(&m_file)) {
  connect(shown, &ShownMoment::moved, this, &ComparedSession::showMoment);
  connect(shown, &ShownMoment::sourceChanged, this, [this] {
    m_here.reset();
    showMoment();
  });
  connect(shown, &ShownMoment::lookingBackChanged, this, &ComparedSession::showMoment);
  connect(&m_file, &ReplayController::frameReceived, this, [this](const FramePtr& frame) {
    const double there = m_shown->time() - m_offset;
    const auto range = m_file.available();
    // A moment that comes late: what is shown has gone on beyond the session.
    const bool inside = range && there >= range->begin - 1e-6 && there <= range->end + 1e-6;
    emit momentReached(inside ? frame : nullptr);
  });
  connect(&m_file, &ReplayController::opened, this, [this] {
    m_here.reset();
    m_there.reset();
    m_offset = offsetByTime();
    showMoment();
    emit changed();
  });
  connect(&m_file, &ReplayController::loadedChanged, this, &ComparedSession::rowsCame);
  connect(&m_file, &ReplayController::rowsCame, this, &ComparedSession::rowsCame);
  connect(&m_file, &ReplayController::failed, this, &ComparedSession::failed);
}

void ComparedSession::open(const QString& path) {
  m_file.open(path);
}

void ComparedSession::stop() {
  m_file.close();
  emit momentReached(nullptr);
  emit changed();
}

const EventList* ComparedSession::events() const {
  return isOn() ? m_events->list() : nullptr;
}

void ComparedSession::setOffset(double seconds) {
  m_offset = seconds;
  showMoment();
  emit changed();
}

void ComparedSession::alignHere(double here) {
  m_here = here;
  align();
}

void ComparedSession::alignThere(double there) {
  m_there = there;
  align();
}

void ComparedSession::align() {
  if (m_here && m_there)
    setOffset(*m_here - *m_there);
  else
    emit changed();
}

void ComparedSession::alignByTime() {
  m_here.reset();
  m_there.reset();
  setOffset(offsetByTime());
}

double ComparedSession::offsetByTime() const {
  const auto here = m_shown->available();
  const auto there = m_file.available();
  if (!here || !there || m_file.info().source != "live") return 0.0;
  return here->begin - there->begin;
}

QString ComparedSession::caption() const {
  if (!isOn()) return {};
  QString text = QFileInfo(m_file.path()).completeBaseName();
  if (m_offset != 0.0) {
    text += QStringLiteral(" · %1%2 s")
                .arg(m_offset < 0 ? QChar(0x2212) : QLatin1Char('+'))
                .arg(std::abs(m_offset), 0, 'f', 2);
  }
  if (m_here && !m_there) text += QStringLiteral(" · choose its event");
  if (m_there && !m_here) text += QStringLiteral(" · choose the event above");
  return text;
}

void ComparedSession::showMoment() {
  if (!isOn()) return;
  const auto range = m_file.available();
  const double there = m_shown->time() - m_offset;
  if (!range || there < range->begin || there > range->end) {
    emit momentReached(nullptr);
    return;
  }
  if (there == m_file.standsAt()) {
    emit momentReached(m_file.frame());
    return;
  }
  m_file.standAt(there);
}

}  // namespace pitchboard::ui
