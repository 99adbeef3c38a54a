// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Turns what a robot sees of the opponents into evidence about them. Metres, seconds, turned so
// that the robot's team attacks towards +x. A plain value: a copy goes on as the original does; one
// thread.

#include <optional>
#include <vector>

#include <robotlink/cognition/situation.h>

#include "opponent_model.h"

namespace pitchboard::link {

class OpponentWatch {
 public:
  /// Call it ten times a second. `model`: the kind of robots that the opponents are compared with.
  void update(const Situation& now, double time, const sim::FieldSpec& field,
              const sim::RobotModel& model, OpponentModel& learned);

 private:
  struct Walk {
    Point from, last;
    double since = 0.0, seen = 0.0;  // s
  };
  struct Roll {
    Point from, last;
    double since = 0.0, seen = 0.0;  // s
  };
  void watchKeeper(const Situation& now, double time, const sim::FieldSpec& field,
                   OpponentModel& learned);
  void watchWalks(double time, const sim::RobotModel& model, OpponentModel& learned);
  void watchBall(const Situation& now, double time, const sim::FieldSpec& field,
                 OpponentModel& learned);

  Points m_before;  // opponents as they stood on the blackboard
  Points m_fresh;   // those that were seen since
  double m_keeperSeen = -1e9;
  std::vector<Walk> m_walks;
  std::optional<Roll> m_roll;
};

}  // namespace pitchboard::link
