// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/ui_queue.h>

#include <sys/eventfd.h>
#include <QSocketNotifier>
#include <utility>

namespace pitchboard::ui {

UiQueue::UiQueue() : m_wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK | EFD_SEMAPHORE)) {
  if (!m_wake) {
    startTimer(20);  // no descriptor is left in this process: look now and then
    return;
  }
  m_notifier = std::make_unique<QSocketNotifier>(m_wake.get(), QSocketNotifier::Read);
  connect(m_notifier.get(), &QSocketNotifier::activated, this, &UiQueue::runNext);
}

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
  if (m_wake) ::eventfd_write(m_wake.get(), 1);
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

void UiQueue::timerEvent(QTimerEvent* /*event*/) {
  runNext();
}

// One call for each time: a call that opens a dialog does not hold up those behind it, and one that
// destroys this object ends here.
void UiQueue::runNext() {
  eventfd_t one = 0;
  if (m_wake) ::eventfd_read(m_wake.get(), &one);
  if (const Call call = next()) call();
}

}  // namespace pitchboard::ui
