// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/blackboard_bridge.h>

#include <algorithm>

namespace pitchboard::link {
namespace {

// The blackboard's floats are IEEE single: this is the one place where percepts are rounded to it.
void writeFloat(Blackboard& board, FloatVar variable, double value) {
  writeIfPresent(board, variable, static_cast<float>(value));
}

void publishImu(const RobotVariables& names, const sim::ImuPercept& imu, Blackboard& board) {
  if (imu.eulerXY) {
    writeFloat(board, names.imuEulerX, (*imu.eulerXY)[0]);
    writeFloat(board, names.imuEulerY, (*imu.eulerXY)[1]);
  }
  writeFloat(board, names.imuEulerZ, imu.eulerZ);
  if (imu.gyro) {
    writeFloat(board, names.imuGyroX, (*imu.gyro)[0]);
    writeFloat(board, names.imuGyroY, (*imu.gyro)[1]);
    writeFloat(board, names.imuGyroZ, (*imu.gyro)[2]);
  }
  if (imu.accel) {
    writeFloat(board, names.imuAccelX, (*imu.accel)[0]);
    writeFloat(board, names.imuAccelY, (*imu.accel)[1]);
    writeFloat(board, names.imuAccelZ, (*imu.accel)[2]);
  }
  if (imu.state) writeIfPresent(board, names.imuState, *imu.state);
  // Only a request is cleared. Any other value may have a meaning for the team, so it stays.
  if (imu.resetDone) replaceIfPresent(board, names.imuReset, 1, 0);
}

void publishControl(const RobotVariables& names, const sim::Percepts& percepts, Blackboard& board) {
  const sim::ControlPercept& control = percepts.control;
  writeIfPresent(board, names.controlAction, control.action);
  writeIfPresent(board, names.voltage, percepts.voltage);
  writeIfPresent(board, names.controlWorking, 1);
  writeIfPresent(board, names.imuWorking, 1);
  if (percepts.decisionWorking) writeIfPresent(board, names.decisionWorking, 1);
  writeIfPresent(board, names.visionWorking, 1);
  if (control.moving) writeIfPresent(board, names.controlMoving, *control.moving);
  if (control.finishedAction)
    replaceIfPresent(board, names.decisionActionA, *control.finishedAction, 0);
}

void publishLandmarks(const RobotVariables& names, const sim::LandmarkPercept& landmarks,
                      Blackboard& board) {
  if (landmarks.ballTiltDeg) writeFloat(board, names.visionTiltDeg, *landmarks.ballTiltDeg);
  if (landmarks.ballPanDeg) writeFloat(board, names.visionPanDeg, *landmarks.ballPanDeg);
  if (landmarks.bearingsDeg) {
    for (std::size_t corner = 0; corner < names.landmarkDeg.size(); ++corner)
      writeFloat(board, names.landmarkDeg[corner], (*landmarks.bearingsDeg)[corner]);
  }
}

}  // namespace

sim::RobotCommand BlackboardBridge::read(const Blackboard& board) const {
  // A variable that the team's map lacks leaves the command at its default: without
  // DECISION_SEARCH_ON the head searches, as it does when a robot is created.
  sim::RobotCommand command;
  const auto read = [&board](IntVar variable, int& value) {
    if (isPresent(variable)) value = board.read(variable);
  };
  read(m_variables.decisionActionA, command.actionA);
  read(m_variables.decisionActionB, command.actionB);
  read(m_variables.decisionSearchOn, command.searchOn);
  read(m_variables.decisionActionVision, command.actionVision);
  read(m_variables.decisionLocalization, command.localizationLook);
  read(m_variables.imuReset, command.imuReset);
  return command;
}

void BlackboardBridge::publish(const sim::Percepts& percepts, Blackboard& board,
                               std::size_t robots) const {
  publishBody(percepts, board);
  publishSight(percepts, board, robots);
}

void BlackboardBridge::publishBody(const sim::Percepts& percepts, Blackboard& board) const {
  publishImu(m_variables, percepts.imu, board);
  publishControl(m_variables, percepts, board);
  publishLandmarks(m_variables, percepts.landmarks, board);
}

void BlackboardBridge::publishSight(const sim::Percepts& percepts, Blackboard& board,
                                    std::size_t robots) const {
  const sim::BallPercept& ball = percepts.ball;
  if (ball.lost) writeIfPresent(board, m_variables.visionLost, *ball.lost);
  if (ball.distanceCm) writeFloat(board, m_variables.visionBallDist, *ball.distanceCm);
  if (ball.angleDeg) writeFloat(board, m_variables.visionBallAngle, *ball.angleDeg);
  if (ball.panDeg) writeFloat(board, m_variables.visionPanDeg, *ball.panDeg);
  for (std::size_t robot = 0; robot < std::min(robots, percepts.robots.size()); ++robot) {
    const auto& seen = percepts.robots[robot];
    if (!seen) continue;
    writeFloat(board, m_variables.robotDist[robot], seen->distanceCm);
    writeFloat(board, m_variables.robotAngle[robot], seen->angleDeg);
  }
  if (percepts.searchOn) writeIfPresent(board, m_variables.decisionSearchOn, *percepts.searchOn);
}

}  // namespace pitchboard::link
