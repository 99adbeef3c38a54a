// SPDX-License-Identifier: GPL-3.0-or-later
// Which robots may play in a rollout, and when it ends.
#include "rollout_world.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::rollout {

link::Referee RolloutWorld::refereeFor(std::size_t i) const {
  switch (m_game.state) {
    case PlayState::Playing:
      return m_game.setPlay != SetPlay::None && m_game.setPlaySide != sideOf(i)
                 ? link::Referee::Ready
                 : link::Referee::Play;
    case PlayState::Ready:
      return link::Referee::Ready;
    case PlayState::Set:
      return link::Referee::Set;
    case PlayState::Initial:
    case PlayState::Finished:
    case PlayState::Standby:
    case PlayState::Unknown:
      break;
  }
  return link::Referee::Stop;
}

/// Whether the ball has left the field, and where.
void RolloutWorld::judge(const Point& before) {
  const sim::FieldSpec& f = field();
  if (!m_looked && m_tick >= m_lookTick) {
    m_look = m_ball;
    m_looked = true;
  }
  const double endX = f.halfLength() + f.ballRadius, endY = f.halfWidth() + f.ballRadius;
  const bool overEnd = std::abs(m_ball.x) > endX, overTouch = std::abs(m_ball.y) > endY;
  if (!overEnd && !overTouch) return;
  const auto shareAt = [](double from, double to, double line) {
    const double metres = std::abs(to) - (to > 0.0 ? from : -from);
    return metres > 0.0 ? std::clamp((line - (to > 0.0 ? from : -from)) / metres, 0.0, 1.0) : 0.0;
  };
  const double atEnd = overEnd ? shareAt(before.x, m_ball.x, endX) : 2.0;
  const double atTouch = overTouch ? shareAt(before.y, m_ball.y, endY) : 2.0;
  const double y = before.y + atEnd * (m_ball.y - before.y);
  const bool goal = overEnd && atEnd <= atTouch && std::abs(y) < f.goalWidth / 2.0;
  if (goal) {
    ++(m_ball.x > 0.0 ? m_goalsLeft : m_goalsRight);
    if (std::isnan(m_timeToGoal)) m_timeToGoal = now();
  }
  if (m_goOn) {
    constexpr double inside = 1.0;  // m
    const double x = f.halfLength() - inside, side = f.halfWidth() - inside;
    restart(goal ? Point{} : Point{std::clamp(m_ball.x, -x, x), std::clamp(m_ball.y, -side, side)});
    return;
  }
  m_ended = goal ? Ended::Goal : Ended::BallOut;
  m_over = true;
}

void RolloutWorld::restart(const Point& ball) {
  m_ball = ball;
  m_ballVelocity = {};
}

}  // namespace pitchboard::rollout
