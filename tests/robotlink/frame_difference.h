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

inline QString difference(const telemetry::LinkHealth& a, const telemetry::LinkHealth& b) {
  SAME(sender);
  SAME(conflict);
  SAME(timedOut);
  SAME(age);
  SAME(messages);
  SAME(bytes);
  SAME(errorCount);
  SAME(recoveries);
  SAME(offline);
  SAME(rate);
  SAME(jitter);
  SAME(loss);
  SAME(lost);
  SAME(duplicates);
  SAME(late);
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
  SAME(belief);
  SAME(sigma);
  SAME(ball);
  SAME(decided);
  SAME(battery);
  for (std::size_t i = 0; i < a.lamps.size(); ++i) {
    SAME(lamps[i].state);
    SAME(lamps[i].probability);
    SAME(lamps[i].since);
  }
  SAME(penalty);
  SAME(values);
  SAME(behaviour);
  SAME(programs);
  SAME(link.has_value());
  return a.link ? difference(*a.link, *b.link) : QString();
}

inline QString difference(const RefereeReception& a, const RefereeReception& b) {
  SAME(version);
  SAME(sender);
  SAME(age);
  SAME(timedOut);
  SAME(conflict);
  SAME(truth);
  SAME(replies.size());
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
  SAME(settings->field.name);
  SAME(robots.size());
  SAME(drawings);
  SAME(game);
  SAME(teamBalls.size());
  for (std::size_t i = 0; i < a.teamBalls.size(); ++i) {
    SAME(teamBalls[i].team);
    SAME(teamBalls[i].position);
    SAME(teamBalls[i].spread);
    SAME(teamBalls[i].agree);
    SAME(teamBalls[i].see);
  }
  if (const QString found = difference(a.reception, b.reception); !found.isEmpty()) {
    return QStringLiteral("referee ") + found;
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
