// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/board_health.h>

#include <chrono>

#include <robotlink/frame/belief.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {

void fillBoardHealth(const sim::FieldSpec& field, const BoardHeard& heard, RobotFrame& robot) {
  constexpr std::array<bool RobotBoardView::*, telemetry::processCount> works{
      &RobotBoardView::controlWorking, &RobotBoardView::visionWorking,
      &RobotBoardView::localizationWorking, &RobotBoardView::decisionWorking,
      &RobotBoardView::imuWorking};
  const RobotBoardView& board = *robot.board;
  RobotHealth& health = robot.health.emplace();
  health.age =
      std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(heard.age));
  health.messages = heard.samples;
  health.rate = heard.gone ? 0.0 : heard.rate;
  health.timedOut = heard.gone;
  for (std::size_t i = 0; i < works.size(); ++i) {
    if (health.timedOut || !heard.hasFlag[i]) continue;
    health.processes[i].state =
        board.*works[i] ? telemetry::ProcessState::Working : telemetry::ProcessState::Silent;
  }
  health.action = board.actionA;
  robot.action = board.actionA;
  if (board.voltage > 0) {
    health.battery = telemetry::batteryAt(board.voltage / 10.0, telemetry::usualBattery);
  }
  health.poseKnown = heard.poseKnown;
  if (!health.poseKnown) return;
  robot.pose = sim::published_frame::studioFromLocalization(field, heard.pose);
  robot.headYaw = robot.pose.yaw;
  if (board.visionWorking && !board.visionLost) {
    health.ball = ballSeenFrom(robot.pose, static_cast<double>(board.ballDistCm),
                               static_cast<double>(board.panDeg), field);
  }
}

}  // namespace pitchboard::link
