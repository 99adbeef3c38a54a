// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/compared_session.h>

#include <QFileInfo>
#include <cmath>
#include <utility>

#include <ui/base/session_mark.h>
#include <ui/sources/event_list.h>
#include <ui/sources/shown_moment.h>

#include "event_collector.h"

namespace pitchboard::ui {
namespace {

using link::MatchEventKind;

/// When PLAYING begins first; s. The state in which a referee is first received did not begin then.
std::optional<double> kickOffIn(const EventList& list) {
  std::optional<double> receivedAt;
  for (const link::MatchEvent& event : list.events()) {
    if (event.kind == MatchEventKind::RefereeReceived) receivedAt = event.time;
    const bool isPlaying =
        event.kind == MatchEventKind::GameState && event.state == PlayState::Playing;
    if (isPlaying && event.time != receivedAt) return event.time;
  }
  return {};
}

}  // namespace

ComparedSession::ComparedSession(quint64 id, ShownMoment* shown, QObject* parent)
    : QObject(parent), m_id(id), m_shown(shown), m_events(new EventCollector(&m_file)) {
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
    emit momentReached(inside && m_isOnField ? frame : nullptr);
  });
  connect(&m_file, &ReplayController::opened, this, [this] {
    m_offset = offsetByTime();
    emit opened();
    showMoment();
  });
  connect(&m_file, &ReplayController::loadedChanged, this, &ComparedSession::rowsCame);
  connect(&m_file, &ReplayController::rowsCame, this, &ComparedSession::rowsCame);
  connect(&m_file, &ReplayController::failed, this, &ComparedSession::failed);
  connect(&m_file, &ReplayController::foreignFound, this, [this](const QString& path) {
    emit failed(QStringLiteral("%1 was recorded by another program. Import it with File > Open "
                               "session…, then export it as a session.")
                    .arg(QFileInfo(path).fileName()));
  });
}

void ComparedSession::open(const QString& path) {
  m_file.open(path);
}

QString ComparedSession::name() const {
  return QFileInfo(m_file.path()).completeBaseName();
}

QString ComparedSession::markedName() const {
  return sessionMark(m_number) + QLatin1Char(' ') + name();
}

void ComparedSession::setMemoryBudget(std::size_t bytes) {
  m_budget = bytes;
  m_file.setMemoryBudget(bytes);
}

std::size_t ComparedSession::memoryUse() const {
  const auto rows = series();
  return rows && m_file.loaded() == 1.0 ? rows->memoryBytes() : m_budget;
}

const EventList* ComparedSession::events() const {
  return m_events->list();
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

std::optional<double> ComparedSession::offsetByKickOff() const {
  const auto here = kickOffIn(*m_shown->events());
  const auto there = kickOffIn(*events());
  if (!here || !there) return {};
  return *here - *there;
}

void ComparedSession::alignByKickOff() {
  const auto offset = offsetByKickOff();
  if (!offset) return;
  m_here.reset();
  m_there.reset();
  setOffset(*offset);
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

void ComparedSession::setOnField(bool on) {
  if (std::exchange(m_isOnField, on) == on) return;
  if (on)
    showMoment();
  else
    emit momentReached(nullptr);
  emit changed();
}

void ComparedSession::setInPlots(bool on) {
  if (std::exchange(m_isInPlots, on) != on) emit changed();
}

QString ComparedSession::caption() const {
  QString text = name();
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
  if (!m_file.isOpen() || !m_isOnField) return;
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
