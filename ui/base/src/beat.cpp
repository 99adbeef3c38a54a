// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/beat.h>

#include <QEvent>
#include <algorithm>
#include <utility>

namespace pitchboard::ui {
namespace {

using Milliseconds = Beat::Milliseconds;

constexpr Milliseconds slowPeriod{250};
// A beat that comes so little too early is the right one.
constexpr Milliseconds early = Beat::period / 2;

}  // namespace

Beat& Beat::display() {
  // It outlives the windows, and the application's end does not concern it.
  static auto* const beat = new Beat;
  return *beat;
}

Beat::Beat() {
  m_next.setSingleShot(true);
  m_next.setTimerType(Qt::PreciseTimer);
  m_slow.setInterval(slowPeriod);
  connect(&m_next, &QTimer::timeout, this, &Beat::beat);
  connect(&m_slow, &QTimer::timeout, this, &Beat::beatSlowly);
}

Beat::~Beat() {
  for (Part* part : m_parts) {
    if (part != nullptr) part->m_beat = nullptr;
  }
}

std::unique_ptr<Beat::Part> Beat::add(QWidget* seen, Milliseconds least, std::function<void()> call,
                                      Milliseconds most) {
  std::unique_ptr<Part> part(new Part);
  part->m_beat = this;
  part->m_seen = seen;
  part->m_always = seen == nullptr;
  part->m_least = least;
  part->m_most = most;
  // The first call is due at once; the clock itself may have begun a minute ago, with the computer.
  part->m_called = Clock::now() - std::max(least, most);
  part->m_call = std::move(call);
  m_parts.push_back(part.get());
  if (seen != nullptr) seen->installEventFilter(this);
  if (most.count() > 0 && !m_slow.isActive()) m_slow.start();
  return part;
}

std::unique_ptr<Beat::Part> Beat::addSource(std::function<void()> call) {
  auto part = add(nullptr, {}, std::move(call));
  part->m_follows = false;
  return part;
}

Beat::Part::~Part() {
  if (m_beat == nullptr) return;
  auto& parts = m_beat->m_parts;
  const auto mine = std::ranges::find(parts, this);
  if (m_beat->m_depth > 0)
    *mine = nullptr;
  else
    parts.erase(mine);
  const auto isSlow = [](const Part* part) { return part != nullptr && part->m_most.count() > 0; };
  if (std::ranges::none_of(parts, isSlow)) m_beat->m_slow.stop();
}

void Beat::Part::want() {
  if (m_wanted) return;
  m_wanted = true;
  if (m_beat != nullptr) m_beat->schedule();
}

/// What follows leaves room for a beat that comes anyway: then there is one repaint and not two.
Beat::Clock::time_point Beat::dueAt(const Part& part) const {
  const auto own = part.m_called + part.m_least;
  const bool waits = part.m_follows && part.m_least > period;
  return std::max(waits ? own + period : own, m_last + period);
}

void Beat::schedule() {
  auto first = Clock::time_point::max();
  for (const Part* part : m_parts) {
    if (part != nullptr && part->m_wanted && part->canBeSeen())
      first = std::min(first, dueAt(*part));
  }
  if (first == Clock::time_point::max()) {
    m_next.stop();
    return;
  }
  const auto wait = std::chrono::ceil<Milliseconds>(first - Clock::now());
  const Milliseconds rest = std::max(wait, Milliseconds(0));
  if (!m_next.isActive() || m_next.remainingTimeAsDuration() > rest) m_next.start(rest);
}

void Beat::beat() {
  const quint64 mine = ++m_beats;
  const auto now = Clock::now();
  m_last = now;
  ++m_depth;
  // What one part shows can be news for another one, whichever came first.
  for (bool again = true; std::exchange(again, false);) {
    for (std::size_t i = 0; i < m_parts.size(); ++i) {
      Part* part = m_parts[i];
      if (part == nullptr || !part->m_wanted || part->m_running) continue;
      if (part->m_calledIn >= mine) continue;
      if (!part->canBeSeen() || now + early < part->m_called + part->m_least) continue;
      part->m_wanted = false;
      part->m_called = now;
      part->m_calledIn = mine;
      again = part->m_running = true;
      const auto call = part->m_call;  // which may destroy the part
      call();
      if (m_parts[i] == part) part->m_running = false;
    }
  }
  if (--m_depth == 0) std::erase(m_parts, nullptr);
  schedule();
}

void Beat::beatSlowly() {
  const auto now = Clock::now();
  for (Part* part : m_parts) {
    if (part == nullptr || part->m_most.count() == 0 || !part->canBeSeen()) continue;
    if (now + early >= part->m_called + part->m_most) part->m_wanted = true;
  }
  schedule();
}

bool Beat::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (event->type() == QEvent::Show) schedule();
  return false;
}

}  // namespace pitchboard::ui
