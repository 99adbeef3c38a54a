// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/naive_decision.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/try.h>
#include <robotlink/cognition/referee_orders.h>

#include "planning/target.h"

namespace pitchboard::link {
namespace {

// DECISION_ACTION_A
constexpr int stop = 0, turnLeft = 2, turnRight = 3, kickRight = 4, kickLeft = 5, walkSlow = 8,
              gait = 11;

int truncated(double value) {
  constexpr double low = std::numeric_limits<int>::min(), high = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(value, low, high));
}

class NaiveDecision final : public CognitiveProcess {
 public:
  explicit NaiveDecision(double distanceToKick) : m_distanceToKick(distanceToKick) {}

  void step(Blackboard& board, const Clock&) override {
    m_target.clear(board);  // of a decision before it, for a planning that still runs
    switch (board.read(m_variables.comReferee)) {
      case refereeStop:
      case refereeReady:
      case refereeSet:
        board.write(m_variables.decisionActionA, stop);
        break;
      case refereePlay:
        play(board);
        break;
      default:  // nobody has spoken yet: the published process does nothing either
        break;
    }
    board.write(m_variables.decisionWorking, 1);
  }

  // The published cycle sleeps 0.05 s and reads two values that take 0.1 s each.
  double period() const override { return 0.05 + 2 * 0.1; }

 private:
  void play(Blackboard& board) const {
    naiveRule(board.read(m_variables.visionLost), board.read(m_variables.visionPanDeg),
              board.read(m_variables.visionBallDist), m_distanceToKick)
        .writeTo(board, m_variables);
  }

  RobotVariables m_variables;
  TargetVariables m_target;
  double m_distanceToKick;
};

}  // namespace

void NaiveOutput::writeTo(Blackboard& board, const RobotVariables& variables) const {
  if (searchOn) board.write(variables.decisionSearchOn, 1);
  if (actionB) board.write(variables.decisionActionB, *actionB);
  board.write(variables.decisionActionA, actionA);
}

NaiveOutput naiveRule(int lost, float panDeg, float distance, double distanceToKick) {
  if (lost != 0 || !std::isfinite(panDeg) || !std::isfinite(distance)) {
    return {.actionA = turnRight, .actionB = {}, .searchOn = true};
  }
  const auto act = [](int action) { return NaiveOutput{action, {}, false}; };
  const int bearing = truncated(panDeg);
  const double d = distance;
  if (40 < bearing && bearing < 160) return act(turnLeft);
  if (-160 < bearing && bearing < -40) return act(turnRight);
  if (d < distanceToKick) return act(bearing <= 0 ? kickRight : kickLeft);
  if (d > 50 || (20 < d && d < 50)) return {walkSlow, truncated(d / 5), false};
  return act(gait);
}

Result<std::unique_ptr<CognitiveProcess>> makeNaiveDecision(const ProcessOptions& options) {
  TRY(validate(options.parameters));
  return std::make_unique<NaiveDecision>(options.parameters.distanceToKick);
}

}  // namespace pitchboard::link
