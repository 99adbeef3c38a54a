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
  auto world = gameFromRow(*layoutOf(match).game, m_rows[match].view());
  if (!world) return;
  const std::size_t left = world->game->leftTeam();
  world->game->teams[left].score = frame.snapshot.score.left;
  world->game->teams[1 - left].score = frame.snapshot.score.right;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present) continue;
    const Layout& layout = layoutOf(i);
    if (layout.robot.value == 0 || layout.isBoard() || !layout.player) continue;
    if (std::abs(m_rows[i].time - m_rows[match].time) > timeTolerance) continue;
    if (const RobotFrame* robot = frame.robot(layout.robot)) {
      addPlayer(*layout.player, m_rows[i].view(), robot->identity, *world);
    }
  }
  showReferee(*world, frame);
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
  if (const auto physics = attribute(info, "physics"); !physics.empty()) settings.physics = physics;
  if (const std::string seed(attribute(info, "seed")); !seed.empty()) {
    settings.seed = std::strtoull(seed.c_str(), nullptr, 10);
  }
  double rate = 0.0;
  const std::string_view text = attribute(info, "tick_rate");
  std::from_chars(text.data(), text.data() + text.size(), rate);
  if (rate >= sim::tickRateParameter.least && rate <= sim::tickRateParameter.most) {
    settings.tickRate = rate;
  }
}

}  // namespace pitchboard::link
