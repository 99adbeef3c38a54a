// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs calls from other threads on the UI thread, in the order of post(). The queue belongs to the
// object that the calls use; calls that have not run when it is destroyed are dropped. It uses a
// std::mutex and an eventfd instead of Qt's event queue, because a thread sanitizer cannot see into
// the latter and would report everything that is passed through it.

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

  /// Create and destroy it on the UI thread. Threads that post must have ended before, except for
  /// those that a waiting call owns.
  UiQueue();
  ~UiQueue() override;

  /// Any thread. The call runs once the UI thread is back in its event loop.
  void post(Call call);
  /// UI thread. Runs all waiting calls now, for programs whose event loop may have ended.
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
