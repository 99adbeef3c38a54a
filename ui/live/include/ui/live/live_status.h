// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the status line says in Live, from looks at the counters.

#include <QString>
#include <deque>
#include <utility>

#include <robotlink/live/live_watch.h>

namespace pitchboard::ui {

struct LiveStatusText {
  QString network;  ///< "UDP 24/s, 0 lost, 0 bad"
  QString referee;  ///< "Referee v12, 2.0/s"
  QString trouble;  ///< the most urgent thing, or nothing: shown in red
  QString tip;      ///< every port and what is wrong with it
};

/// How often a counter grows, over the last five seconds.
class RateWindow {
 public:
  /// `seconds`: any monotonic clock. Returns the rate, 1/s.
  double look(double seconds, quint64 count);

 private:
  std::deque<std::pair<double, quint64>> m_looks;
};

class LiveStatus {
 public:
  /// `seconds`: any monotonic clock.
  LiveStatusText update(const link::LiveDetails& details, const link::MatchFrame* frame,
                        double seconds);

 private:
  RateWindow m_robots, m_referee;
};

}  // namespace pitchboard::ui
