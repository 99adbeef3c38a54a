// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the status line says in Live, from two looks at the counters.

#include <QString>

#include <robotlink/live/live_watch.h>

namespace pitchboard::ui {

struct LiveStatusText {
  QString network;  ///< "UDP 24/s, 0 lost, 0 bad"
  QString referee;  ///< "Referee: version 12, 2/s"
  QString trouble;  ///< the most urgent thing, or nothing: shown in red
  QString tip;      ///< every port and what is wrong with it
};

class LiveStatus {
 public:
  /// `seconds`: any monotonic clock.
  LiveStatusText update(const link::LiveDetails& details, const link::MatchFrame* frame,
                        double seconds);

 private:
  struct Look {
    double seconds = 0.0;
    quint64 datagrams = 0;
    quint64 referee = 0;
  };
  Look m_before, m_now;
  double m_rate = 0.0, m_refereeRate = 0.0;
};

}  // namespace pitchboard::ui
