// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/compared_sessions.h>

#include <QFileInfo>
#include <algorithm>
#include <utility>

#include <ui/sources/compared_session.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

ComparedSessions::ComparedSessions(ShownMoment* shown, QObject* parent)
    : QObject(parent), m_shown(shown) {}

void ComparedSessions::open(const QStringList& paths) {
  if (paths.isEmpty()) return;
  emit started();
  QStringList refused;
  for (const QString& path : paths) {
    if (m_sessions.size() + m_asked.size() < std::size_t{maxComparedSessions})
      m_asked.push_back({path, {}});
    else
      refused << QFileInfo(path).fileName();
  }
  if (!refused.isEmpty()) {
    m_problems << QStringLiteral(
                      "At most %1 sessions can be compared. Not opened: %2. Remove others first.")
                      .arg(maxComparedSessions)
                      .arg(refused.join(QStringLiteral(", ")));
  }
  if (m_opening == nullptr) openNext();
}

void ComparedSessions::openNext() {
  if (m_asked.empty()) {
    const QStringList problems = std::exchange(m_problems, {});
    if (!problems.isEmpty()) emit failed(problems.join(QLatin1Char(' ')));
    return;
  }
  m_opening = new ComparedSession(++m_lastId, m_shown, this);
  m_opening->setMemoryBudget(budgetOfNext());
  connect(m_opening, &ComparedSession::opened, this, &ComparedSessions::take);
  connect(m_opening, &ComparedSession::failed, this, [this](const QString& sentence) {
    m_problems << sentence;
    m_opening->deleteLater();
    m_opening = nullptr;
    m_asked.pop_front();
    openNext();
  });
  m_opening->open(m_asked.front().path);
}

/// The file that was being opened is open.
void ComparedSessions::take() {
  ComparedSession* session = std::exchange(m_opening, nullptr);
  const Asked asked = m_asked.front();
  m_asked.pop_front();
  session->disconnect(this);
  session->setNumber(freeNumber());
  m_sessions.push_back(session);
  if (asked.offset) session->setOffset(*asked.offset);
  connect(session, &ComparedSession::changed, this, &ComparedSessions::changed);
  connect(session, &ComparedSession::rowsCame, this, &ComparedSessions::rowsCame);
  connect(session, &ComparedSession::momentReached, this,
          [this, session](const FramePtr& frame) { emit momentReached(session->number(), frame); });
  emit changed();
  openNext();
}

int ComparedSessions::freeNumber() const {
  int number = 1;
  while (std::ranges::any_of(m_sessions, [number](const ComparedSession* session) {
    return session->number() == number;
  })) {
    ++number;
  }
  return number;
}

ComparedSession* ComparedSessions::find(quint64 id) const {
  const auto found = std::ranges::find(m_sessions, id, &ComparedSession::id);
  return found == m_sessions.end() ? nullptr : *found;
}

void ComparedSessions::remove(ComparedSession* session) {
  const auto found = std::ranges::find(m_sessions, session);
  if (found == m_sessions.end()) return;
  m_sessions.erase(found);
  session->disconnect(this);
  session->deleteLater();  // its own menu may have asked for this
  emit momentReached(session->number(), nullptr);
  emit changed();
}

void ComparedSessions::removeAll() {
  if (m_opening != nullptr) m_opening->disconnect(this);
  if (m_opening != nullptr) m_opening->deleteLater();
  m_opening = nullptr;
  m_asked.clear();
  m_problems.clear();
  for (ComparedSession* session : std::exchange(m_sessions, {})) {
    session->disconnect(this);
    session->deleteLater();
    emit momentReached(session->number(), nullptr);
  }
  emit changed();
}

std::size_t ComparedSessions::budgetOfNext() const {
  std::size_t used = 0;
  for (const ComparedSession* session : m_sessions) used += session->memoryUse();
  const std::size_t left = used < m_budget ? m_budget - used : 0;
  return std::max(left / m_asked.size(), m_budget / maxComparedSessions);
}

void ComparedSessions::setMemoryBudget(std::size_t bytes) {
  m_budget = bytes;
  for (ComparedSession* session : m_sessions) {
    session->setMemoryBudget(std::max<std::size_t>(bytes / m_sessions.size(), 1));
  }
}

void ComparedSessions::alignAllByTime() {
  for (ComparedSession* session : m_sessions) session->alignByTime();
}

bool ComparedSessions::areAlignedByTime() const {
  return std::ranges::all_of(m_sessions, &ComparedSession::isAlignedByTime);
}

void ComparedSessions::openInstead(ComparedSession* session) {
  const auto* replay = qobject_cast<const ReplayController*>(m_shown->source());
  m_instead = {session->id(), session->path(), replay != nullptr ? replay->path() : QString(),
               session->offset(), m_shown->time()};
  emit openRequested(session->path());
}

void ComparedSessions::finishInstead() {
  if (!m_instead) return;
  const Instead done = *std::exchange(m_instead, {});
  for (ComparedSession* session : m_sessions) session->setOffset(session->offset() - done.offset);
  if (ComparedSession* session = find(done.session)) remove(session);
  if (!done.shown.isEmpty()) {
    m_asked.push_back({done.shown, -done.offset});
    if (m_opening == nullptr) openNext();
  }
  m_shown->seek(done.time - done.offset);
}

}  // namespace pitchboard::ui
