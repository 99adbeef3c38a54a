// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_orders.h"

#include <QUndoStack>
#include <optional>
#include <vector>

#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

/// What the call changed; filled and read on the match's thread.
struct RefereeCommand::Before {
  std::optional<sim::GameState> game;
  std::optional<Point> ball;
  Velocity ballVelocity;
  std::vector<std::pair<RobotId, Pose>> robots;
};

RefereeCommand::RefereeCommand(MatchController* match, const sim::RefereeCall& call,
                               const QString& words)
    : QUndoCommand(words), m_match(match), m_call(call), m_before(std::make_shared<Before>()) {}

void RefereeCommand::redo() {
  m_match->post(
      MatchOrder{QStringLiteral("The referee's call was not carried out"),
                 [call = m_call, before = m_before](link::SimulatedMatch& match) -> Result<void> {
                   sim::Simulation& simulation = match.simulation();
                   *before = {};
                   const std::optional<sim::GameState> game = simulation.state().game;
                   const sim::Snapshot then = simulation.snapshot();
                   if (auto called = match.call(call); !called) return called;
                   before->game = game;
                   const sim::Snapshot now = simulation.snapshot();
                   if (now.ball != then.ball) {
                     before->ball = then.ball;
                     before->ballVelocity = then.ballVelocity;
                   }
                   for (std::size_t i = 0; i < now.robots.size(); ++i) {
                     if (now.robots[i].pose == then.robots[i].pose) continue;
                     before->robots.emplace_back(then.robots[i].identity.id, then.robots[i].pose);
                   }
                   return {};
                 }});
}

void RefereeCommand::undo() {
  m_match->post(MatchOrder{QStringLiteral("The referee's call was not undone"),
                           [before = m_before](link::SimulatedMatch& match) -> Result<void> {
                             if (!before->game) return {};  // it had been refused
                             sim::Simulation& simulation = match.simulation();
                             if (auto put = simulation.setGame(*before->game); !put) return put;
                             if (before->ball) {
                               (void)simulation.placeBall(*before->ball, before->ballVelocity);
                             }
                             for (const auto& [robot, pose] : before->robots) {
                               (void)simulation.placeRobot(robot, pose);
                             }
                             return {};
                           }});
}

void callReferee(MatchController* match, const sim::RefereeCall& call, const QString& words) {
  if (match->isOpen()) {
    match->edits()->undoStack()->push(new RefereeCommand(match, call, words));
  }
}

}  // namespace pitchboard::ui
