// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/ui_queue.h>

#include <QCoreApplication>
#include <QEvent>
#include <utility>

namespace pitchboard::ui {

namespace {

QEvent::Type somethingWaits() {
  static const auto type = static_cast<QEvent::Type>(QEvent::registerEventType());
  return type;
}

}  // namespace

UiQueue::~UiQueue() {
  std::deque<Call> dropped;
  const std::lock_guard lock(m_mutex);
  dropped.swap(m_waiting);
}

void UiQueue::post(Call call) {
  {
    const std::lock_guard lock(m_mutex);
    m_waiting.push_back(std::move(call));
  }
  QCoreApplication::postEvent(this, new QEvent(somethingWaits()));
}

UiQueue::Call UiQueue::next() {
  const std::lock_guard lock(m_mutex);
  if (m_waiting.empty()) return {};
  Call call = std::move(m_waiting.front());
  m_waiting.pop_front();
  return call;
}

void UiQueue::deliver() {
  while (const Call call = next()) call();
}

// One call for each event: a call that opens a dialog does not hold up those behind it, and one
// that destroys this object ends here.
bool UiQueue::event(QEvent* event) {
  if (event->type() != somethingWaits()) return QObject::event(event);
  if (const Call call = next()) call();
  return true;
}

}  // namespace pitchboard::ui
