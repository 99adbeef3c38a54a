// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the text of the status bar in Live from the counters of the watch. One thread at a time.

#include <QString>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include <robotlink/live/live_watch.h>

namespace pitchboard::ui {

struct LiveStatusText {
  QString network;  ///< "UDP 24/s, 0 lost, 0 bad"
  QString referee;  ///< "Referee v12, 2.0/s"
  QString trouble;  ///< the newest problem, shown in red, and how many more; empty: none
  QString tip;      ///< all problems, and all ports
};

/// Something that goes wrong in Live. `key` stays while it goes on, `text` may change.
struct LiveTrouble {
  QString key, text;
};

/// Returns how a program that sends topics is received: "foxglove_bridge, 12 of 15 topics, ...".
/// What is not read follows in lines of its own.
QString topicsText(const link::TopicSourceStatus& source);

/// Measures how fast a counter grows over the last five seconds.
class RateWindow {
 public:
  /// Adds a value of the counter and returns the rate in 1/s. `seconds` is from a monotonic clock.
  double look(double seconds, quint64 count);

 private:
  std::deque<std::pair<double, quint64>> m_looks;
};

class LiveStatus {
 public:
  /// `seconds` is from a monotonic clock.
  LiveStatusText update(const link::LiveDetails& details, const link::MatchFrame* frame,
                        double seconds);

 private:
  /// Returns the newest of these problems; of those that began together, the first.
  QString newestOf(const std::vector<LiveTrouble>& troubles, double seconds);

  RateWindow m_robots, m_referee;
  std::map<QString, double> m_since;  // when each problem that goes on began, by its key
};

}  // namespace pitchboard::ui
