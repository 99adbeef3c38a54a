// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Compares two frames field by field, for tests of what is replayed.

#include <QString>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

#define SAME(member)                                             \
  do {                                                           \
    if (!(a.member == b.member)) return QStringLiteral(#member); \
  } while (false)

inline QString difference(const RobotHealth& a, const RobotHealth& b) {
  SAME(sender);
  SAME(conflict);
  SAME(timedOut);
  SAME(age);
  SAME(messages);
  SAME(bytes);
  SAME(errorCount);
  SAME(recoveries);
  SAME(rate);
  SAME(jitter);
  SAME(loss);
  SAME(lost);
  SAME(duplicates);
  SAME(late);
  for (std::size_t i = 0; i < a.processes.size(); ++i) {
    SAME(processes[i].state);
    SAME(processes[i].probability);
    SAME(processes[i].since);
  }
  SAME(battery);
  SAME(poseKnown);
  SAME(action);
  SAME(ball);
  SAME(penalty);
  SAME(values);
  return {};
}

inline QString difference(const RobotBoardView& a, const RobotBoardView& b) {
  SAME(actionA);
  SAME(voltage);
  SAME(visionLost);
  SAME(ballDistCm);
  SAME(panDeg);
  SAME(localizationX);
  SAME(localizationY);
  SAME(localizationTheta);
  SAME(belief);
  SAME(controlWorking);
  SAME(visionWorking);
  SAME(localizationWorking);
  SAME(decisionWorking);
  SAME(imuWorking);
  return {};
}

inline QString difference(const RobotFrame& a, const RobotFrame& b) {
  SAME(key);
  SAME(name);
  SAME(identity.number);
  SAME(identity.team);
  SAME(ownName);
  SAME(pose);
  SAME(headYaw);
  SAME(velocity);
  SAME(action);
  SAME(fallen);
  SAME(board.has_value());
  SAME(health.has_value());
  if (a.board) {
    if (const QString found = difference(*a.board, *b.board); !found.isEmpty()) return found;
  }
  return a.health ? difference(*a.health, *b.health) : QString();
}

inline QString difference(const RefereeView& a, const RefereeView& b) {
  SAME(version);
  SAME(sender);
  SAME(age);
  SAME(timedOut);
  SAME(conflict);
  SAME(truth.has_value());
  SAME(replies.size());
  SAME(state);
  SAME(setPlay);
  SAME(phase);
  SAME(firstHalf);
  SAME(stopped);
  SAME(secondsLeft);
  SAME(secondaryTime);
  SAME(countdown);
  SAME(performingTeam);
  SAME(setPlayStep);
  SAME(kickOffTeam);
  for (std::size_t i = 0; i < a.teams.size(); ++i) {
    SAME(teams[i].number);
    SAME(teams[i].colour);
    SAME(teams[i].score);
    SAME(teams[i].playersLeft);
  }
  SAME(ourTeam);
  return {};
}

/// The first field in which a replayed frame is not what was seen; empty: none.
inline QString difference(const MatchFrame& a, const MatchFrame& b) {
  SAME(truthKnown);
  SAME(ballKnown);
  SAME(snapshot.time);
  SAME(snapshot.score);
  SAME(snapshot.clock);
  SAME(snapshot.clockRunning);
  SAME(field.name);
  SAME(robots.size());
  SAME(drawings);
  SAME(referee.has_value());
  SAME(teamBall.has_value());
  if (a.teamBall) {
    SAME(teamBall->position);
    SAME(teamBall->spread);
    SAME(teamBall->agree);
    SAME(teamBall->see);
  }
  if (a.referee) {
    if (const QString found = difference(*a.referee, *b.referee); !found.isEmpty()) {
      return QStringLiteral("referee ") + found;
    }
  }
  for (std::size_t i = 0; i < a.robots.size(); ++i) {
    if (const QString found = difference(a.robots[i], b.robots[i]); !found.isEmpty()) {
      return QStringLiteral("robot %1 ").arg(QString::fromStdString(a.robots[i].name)) + found;
    }
  }
  return {};
}
#undef SAME

}  // namespace pitchboard::link
