// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs in which a team's own programs play. They know nothing of turns: the match keeps a pace that
// they can follow, begins when they are there, and how well they kept up is measured. For the
// thread that plays the run.

#include <atomic>
#include <chrono>

#include <robotlink/match/match_player.h>

namespace pitchboard::link {

class TeamPrograms {
 public:
  using Clock = std::chrono::steady_clock;
  /// `speed`: times real time, at most. The match must outlive it.
  TeamPrograms(MatchPlayer& player, double speed)
      : m_player(player), m_speed(speed), m_now(speed) {}

  /// Until the match awaits none of its programs (MatchPlayer::awaitPrograms()). Error NotFound
  /// when one of them does not run; none when `cancelled`.
  Result<void> begin(const std::atomic<bool>* cancelled);
  /// Until the next tick is due; looks after the processes meanwhile.
  void wait();
  /// What the slowest of them kept of the match's pace: 1 = all.
  double keptUp() const { return m_looks > 0 ? m_kept / m_looks : 1.0; }

 private:
  Result<void> missing() const;
  void look(Clock::time_point now);
  void setSpeed(double speed, Clock::time_point now);

  MatchPlayer& m_player;
  Pacer m_pacer;
  double m_speed, m_now;  // times real time: wanted, at present
  double m_kept = 0.0, m_looks = 0.0;
  Clock::time_point m_looked{}, m_followed{};
};

}  // namespace pitchboard::link
