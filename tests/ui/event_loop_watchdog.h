// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long the window does not react: the longest time between two turns of the event loop. It is
// the processor time of this thread, so that a computer that is busy with other programs fails no
// test; gap_ms() is what a clock on the wall says. UI thread.

#include <QElapsedTimer>
#include <QTimer>
#include <algorithm>
#include <ctime>

namespace pitchboard::tests {

class EventLoopWatchdog : public QTimer {
 public:
  EventLoopWatchdog() {
    setInterval(1);
    connect(this, &QTimer::timeout, this, [this] {
      const double now = worked_ms();
      m_longest = std::max(m_longest, now - m_last);
      m_last = now;
      m_gap = std::max(m_gap, static_cast<double>(m_clock.nsecsElapsed()) / 1e6);
      m_clock.start();
    });
    m_last = worked_ms();
    m_clock.start();
    start();
  }
  double longest_ms() const { return m_longest; }
  double gap_ms() const { return m_gap; }

 private:
  static double worked_ms() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) / 1e6;
  }
  double m_last = 0.0, m_longest = 0.0, m_gap = 0.0;
  QElapsedTimer m_clock;
};

}  // namespace pitchboard::tests
