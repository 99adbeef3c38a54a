// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What other threads hand to the UI thread: calls, run there in the order of post(). Owned by
// whoever the calls are meant for; what has not run when it goes is dropped, so a call may use its
// owner. The calls wait under a std::mutex, and a counter of the kernel wakes the event loop: a
// thread sanitizer cannot see into Qt's event queue, and would report whatever crosses there, even
// an empty event.

#include <QObject>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include <base/unique_fd.h>

class QSocketNotifier;

namespace pitchboard::ui {

class UiQueue : public QObject {
 public:
  using Call = std::function<void()>;

  /// UI thread, as is the destructor. Threads that post must have ended before that, but for those
  /// that a waiting call owns.
  UiQueue();
  ~UiQueue() override;

  /// Any thread. The call runs when the UI thread is back in its event loop.
  void post(Call call);
  /// UI thread. Runs what waits, for a program whose event loop may have ended.
  void deliver();

 protected:
  void timerEvent(QTimerEvent* event) override;

 private:
  Call next();
  void runNext();

  UniqueFd m_wake;  // an eventfd that counts what was posted
  std::unique_ptr<QSocketNotifier> m_notifier;
  std::mutex m_mutex;
  std::deque<Call> m_waiting;  // guarded by m_mutex
};

}  // namespace pitchboard::ui
