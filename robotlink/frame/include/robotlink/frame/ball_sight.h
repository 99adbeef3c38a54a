// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides when a robot has lost the ball and when it sees it again, for simulated and live robots
// alike. A ball that is out of sight for a moment (the head turns, another robot stands between) is
// not lost, so that a robot tells of the ball at most once every lostAfter seconds. A plain value;
// times in seconds of the source.

#include <optional>

#include <robotlink/frame/match_event.h>

namespace pitchboard::link {

class BallSight {
 public:
  static constexpr double lostAfter = 2.0;  ///< s without seeing it

  /// To be called again and again, with times that do not go back. Returns BallLost or BallSeen
  /// when that has changed; nothing at the first call, which only tells what there was to see.
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
