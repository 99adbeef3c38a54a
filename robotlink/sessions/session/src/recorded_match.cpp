// SPDX-License-Identifier: GPL-3.0-or-later
// What a recorded frame says of the match as a whole: ball, clock, score, and the referee's game.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include <robotlink/match/referee_packet.h>
#include <robotlink/session/recorded_frame.h>
#include <simcore/world/parameters.h>

#include "recorded_layout.h"

namespace pitchboard::link {

/// The scoreboard of a simulated match, from the columns of its game.
void RecordedFrames::addGame(std::size_t match, MatchFrame& frame) {
  auto recorded = gameFromRow(*layoutOf(match).game, m_rows[match].view());
  if (!recorded) return;
  Game& game = recorded->game;
  std::vector<sim::RobotIdentity> robots;
  const std::size_t left = game.leftTeam();
  game.teams[left].score = frame.snapshot.score.left;
  game.teams[1 - left].score = frame.snapshot.score.right;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present) continue;
    const Layout& layout = layoutOf(i);
    if (layout.robot.value == 0 || layout.isBoard() || !layout.player) continue;
    if (std::abs(m_rows[i].time - m_rows[match].time) > timeTolerance) continue;
    if (const RobotFrame* robot = frame.robot(layout.robot)) {
      robots.push_back(robot->identity);
      addPlayer(*layout.player, m_rows[i].view(), robots, game);
    }
  }
  showReferee(game, recorded->rules, frame);
}

void RecordedFrames::fillMatch(std::size_t group, MatchFrame& frame, FrameSettings& settings) {
  const Layout& l = layoutOf(group);
  const telemetry::RowView row = m_rows[group].view();
  sim::GameSnapshot& s = frame.snapshot;
  s.time = row.time;
  s.ball = {l.ballX.readOr(row, 0.0), l.ballY.readOr(row, 0.0)};
  frame.ballKnown = std::isfinite(l.ballX.read(row)) && std::isfinite(l.ballY.read(row));
  s.ballVelocity = {l.ballVx.readOr(row, 0.0), l.ballVy.readOr(row, 0.0)};
  s.clock = l.clock.readOr(row, 0.0);
  s.clockRunning = l.clockRunning.readOr(row, 0.0) != 0.0;
  s.score = {l.scoreLeft.readInt(row), l.scoreRight.readInt(row)};
  s.tick = static_cast<std::uint64_t>(std::clamp(l.tick.readOr(row, 0.0), 0.0, 9e15));
  frame.tickMicroseconds = l.tickTime.readOr(row, 0.0);
  const telemetry::GroupInfo& info = *m_groups[group];
  if (!info.match) return;
  if (!info.match->physics.empty()) settings.physics = info.match->physics;
  settings.seed = info.match->seed.value_or(settings.seed);
  const double rate = info.match->tickRate_hz.value_or(0.0);
  if (rate >= sim::tickRateParameter.least && rate <= sim::tickRateParameter.most) {
    settings.tickRate = rate;
  }
}

}  // namespace pitchboard::link
