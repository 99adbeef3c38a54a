// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_orders.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <robotlink/scenario/referee_rule_sets.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {
namespace {

/// What the decision changed; filled and read on the match's thread.
struct BeforeDecision {
  bool decided = false;
  std::optional<sim::RefereeRules> rules;
  std::optional<sim::GameState> game;
  sim::Score score;
  bool clockRunning = false;
  std::uint64_t clockTicks = 0;
  std::vector<sim::RobotIdentity> identities;  // they tell the sides
  std::optional<Point> ball;
  Velocity ballVelocity;
  std::vector<std::pair<RobotId, Pose>> moved;

  void take(const sim::WorldState& state) {
    *this = {};
    rules = state.settings.referee;
    game = state.game;
    score = state.score;
    clockRunning = state.clockRunning;
    clockTicks = state.clockTicks;
    identities = state.robots;
  }

  Result<void> putBack(sim::Simulation& simulation) const {
    sim::WorldState state = simulation.state();
    state.settings.referee = rules;
    state.game = game;
    state.score = score;
    state.clockRunning = clockRunning;
    state.clockTicks = clockTicks;
    for (sim::RobotIdentity& robot : state.robots) {
      for (const sim::RobotIdentity& known : identities) {
        if (known.id == robot.id) robot.imuStartsAt180 = known.imuStartsAt180;
      }
    }
    if (auto restored = simulation.restore(state); !restored) return restored;
    if (ball) (void)simulation.placeBall(*ball, ballVelocity);
    for (const auto& [robot, pose] : moved) (void)simulation.placeRobot(robot, pose);
    return {};
  }
};

/// `whatFailed` stands before the reason when `decide` fails.
template <class Decide>
void performDecision(MatchEdits* edits, const QString& text, const QString& whatFailed,
                     Decide decide) {
  const auto before = std::make_shared<BeforeDecision>();
  const MatchOrder redo{whatFailed, [decide, before](link::SimulatedMatch& match) -> Result<void> {
                          const sim::Simulation& simulation = match.simulation();
                          const sim::Snapshot then = simulation.snapshot();
                          before->take(simulation.state());
                          if (auto decided = decide(match); !decided) return decided;
                          before->decided = true;
                          const sim::Snapshot now = simulation.snapshot();
                          if (now.ball != then.ball) {
                            before->ball = then.ball;
                            before->ballVelocity = then.ballVelocity;
                          }
                          for (std::size_t i = 0; i < now.robots.size(); ++i) {
                            if (now.robots[i].pose == then.robots[i].pose) continue;
                            before->moved.emplace_back(then.robots[i].identity.id,
                                                       then.robots[i].pose);
                          }
                          return {};
                        }};
  const MatchOrder undo{QStringLiteral("The referee's decision was not undone"),
                        [before](link::SimulatedMatch& match) -> Result<void> {
                          if (!before->decided) return {};  // it had been refused
                          return before->putBack(match.simulation());
                        }};
  edits->perform(
      {text, [edits, redo] { edits->order(redo); }, [edits, undo] { edits->order(undo); }});
}

}  // namespace

void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& words) {
  performDecision(edits, words, QStringLiteral("The referee's call was not carried out"),
                  [call](link::SimulatedMatch& match) { return match.simulation().call(call); });
}

void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title) {
  performDecision(edits, QStringLiteral("rules: ") + title,
                  QStringLiteral("The rules were not changed"),
                  [ruleSet](link::SimulatedMatch& match) -> Result<void> {
                    auto rules = link::refereeRuleSet(ruleSet);
                    if (!rules) return tl::unexpected(rules.error());
                    return match.simulation().setReferee(*rules);
                  });
}

}  // namespace pitchboard::ui
