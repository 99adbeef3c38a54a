// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides when a robot has lost the ball and when it sees it again, for simulated and live robots.
// A ball that is out of sight for less than lostAfter seconds (the head turns, another robot stands
// in between) does not count as lost. Times are seconds of the source. A plain value; not
// thread-safe.

#include <optional>

#include <robotlink/frame/match_event.h>

namespace pitchboard::link {

class BallSight {
 public:
  static constexpr double lostAfter = 2.0;  ///< s without seeing it

  /// Call it for every frame, with times that do not decrease. Returns BallLost or BallSeen when
  /// that has changed. The first call only initializes and returns nothing.
  std::optional<MatchEventKind> look(bool isSeen, double time) {
    const bool isFirst = !m_known;
    const bool was = m_known.value_or(isSeen);
    if (isSeen) m_lastSeen = time;
    m_known = isSeen || (was && time - m_lastSeen < lostAfter);
    if (isFirst || *m_known == was) return {};
    return *m_known ? MatchEventKind::BallSeen : MatchEventKind::BallLost;
  }

 private:
  std::optional<bool> m_known;
  double m_lastSeen = 0.0;
};

}  // namespace pitchboard::link
