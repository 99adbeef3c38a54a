// SPDX-License-Identifier: GPL-3.0-or-later
// MatchController's edits by hand and orders to single robots: each becomes a command that the
// match's thread carries out between two ticks.
#include <QUndoStack>
#include <algorithm>
#include <set>

#include <ui/base/robot_words.h>
#include <ui/sources/match_controller.h>

#include "edit_commands.h"

namespace pitchboard::ui {
namespace {

template <class Used>
int smallestFree(const Used& used) {
  int number = 1;
  while (used.count(number) != 0) ++number;
  return number;
}

}  // namespace

void MatchController::moveRobots(const std::vector<RobotPlacement>& placements) {
  if (m_runner && !placements.empty()) {
    m_undoStack->push(new PlacementCommand(this, placements));
  }
}

void MatchController::moveBall(Point from, Point to) {
  if (m_runner) m_undoStack->push(new BallCommand(this, from, to));
}

void MatchController::previewRobots(const std::vector<RobotPlacement>& placements) {
  placeRobots(placements, false);
}

void MatchController::previewBall(Point position) {
  placeBall(position);
}

void MatchController::addRobot(TeamColor team, const Pose& pose, std::optional<int> number) {
  if (!m_runner) return;
  std::set<int> ids, numbers;
  for (const auto& [id, entry] : m_robots) {
    ids.insert(id.value);
    if (entry.identity.team == team) numbers.insert(entry.identity.number);
  }
  if (static_cast<int>(ids.size()) >= sim::Simulation::maxRobots) {
    emit errorOccurred(tr("No more than %1 robots fit on a field. Remove one first.")
                           .arg(sim::Simulation::maxRobots));
    return;
  }
  link::ScenarioRobot entry;
  entry.identity = {RobotId{smallestFree(ids)}, team, number.value_or(smallestFree(numbers)),
                    info(team).facesLeft};
  entry.pose = pose;
  if (numbers.count(entry.identity.number) != 0) {
    emit errorOccurred(
        tr("%1 is on the field already. Choose another number.").arg(robotName(entry.identity)));
    return;
  }
  m_undoStack->push(new AddRobotCommand(this, entry));
}

void MatchController::removeRobots(const std::vector<RobotId>& ids) {
  std::vector<link::ScenarioRobot> leaving;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr) continue;
    leaving.push_back(*known);
    if (!m_frame) continue;
    if (const link::RobotFrame* seen = m_frame->robot(id)) leaving.back().pose = seen->pose;
  }
  if (!leaving.empty()) m_undoStack->push(new RemoveRobotsCommand(this, std::move(leaving)));
}

void MatchController::setTeam(const std::vector<RobotId>& ids, TeamColor team) {
  if (!m_runner) return;
  std::set<int> numbers;
  for (const auto& [id, entry] : m_robots) {
    if (entry.identity.team == team) numbers.insert(entry.identity.number);
  }
  std::vector<sim::RobotIdentity> before, after;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr || known->identity.team == team) continue;
    const int number = smallestFree(numbers);
    numbers.insert(number);
    before.push_back(known->identity);
    after.push_back({id, team, number, info(team).facesLeft});
  }
  if (!after.empty()) {
    m_undoStack->push(new TeamCommand(this, std::move(before), std::move(after)));
  }
}

void MatchController::changeIdentities(const std::vector<sim::RobotIdentity>& identities) {
  for (const sim::RobotIdentity& identity : identities) {
    const auto known = m_robots.find(identity.id);
    if (known == m_robots.end()) continue;
    const sim::RobotIdentity before = std::exchange(known->second.identity, identity);
    postChecked(
        tr("%1 stays in its team").arg(robotName(before)),
        [identity](link::SimulatedMatch& match) { return match.setIdentity(identity); },
        [this, before] {
          const auto still = m_robots.find(before.id);
          if (still != m_robots.end()) still->second.identity = before;
        });
  }
}

void MatchController::insertRobot(const link::ScenarioRobot& entry) {
  m_robots.insert_or_assign(entry.identity.id, entry);
  postChecked(
      tr("%1 cannot be added").arg(robotName(entry.identity)),
      [entry](link::SimulatedMatch& match) { return match.addRobot(entry); },
      [this, id = entry.identity.id] { m_robots.erase(id); });
}

void MatchController::eraseRobot(RobotId id) {
  const link::ScenarioRobot* known = robot(id);
  const QString name = known ? robotName(known->identity) : tr("The robot");
  m_robots.erase(id);
  postChecked(tr("%1 cannot be removed").arg(name),
              [id](link::SimulatedMatch& match) { return match.removeRobot(id); });
}

void MatchController::placeRobots(const std::vector<RobotPlacement>& placements, bool back) {
  post([placements, back](link::SimulatedMatch& match) {
    // A robot that left meanwhile has nothing to be placed.
    for (const RobotPlacement& placement : placements) {
      (void)match.simulation().placeRobot(placement.id, back ? placement.from : placement.to);
    }
  });
}

void MatchController::placeBall(Point position) {
  postChecked(tr("The ball cannot be placed"), [position](link::SimulatedMatch& match) {
    return match.simulation().placeBall(position);
  });
}

void MatchController::commandAction(RobotId id, int actionA, std::optional<int> actionB) {
  post([id, actionA, actionB](link::SimulatedMatch& match) {
    link::Blackboard* board = match.blackboard(id);
    if (board == nullptr) return;
    // B first: control reads it in the moment it sees a new A.
    if (actionB) board->write(match.variables().decisionActionB, *actionB);
    board->write(match.variables().decisionActionA, actionA);
  });
}

void MatchController::commandSearch(RobotId id, bool on) {
  post([id, on](link::SimulatedMatch& match) {
    if (link::Blackboard* board = match.blackboard(id)) {
      board->write(match.variables().decisionSearchOn, on ? 1 : 0);
    }
  });
}

void MatchController::writeVariable(RobotId id, const QString& name, double value) {
  const link::Variable* variable = m_catalog->find(name.toStdString());
  const QString failed = tr("%1 is not written").arg(name);
  if (variable == nullptr) {
    emit errorOccurred(tr("%1: this match's catalog has no such variable.").arg(failed));
    return;
  }
  postChecked(failed,
              [this, id, name, value, type = variable->type, index = variable->index,
               generation = m_generation.load()](link::SimulatedMatch& match) -> Result<void> {
                link::Blackboard* board = match.blackboard(id);
                if (board == nullptr) {
                  return failure(ErrorCode::NotFound, "the robot is not on the field any more");
                }
                if (type == link::VariableType::Int) {
                  board->write(link::IntVar{index}, static_cast<int>(value));
                } else {
                  board->write(link::FloatVar{index}, static_cast<float>(value));
                }
                const sim::WorldState& state = match.simulation().state();
                const double time = static_cast<double>(state.tick) / state.settings.tickRate;
                QMetaObject::invokeMethod(
                    this,
                    [this, id, name, time, generation] {
                      if (generation == m_generation) emit variableWritten(id, name, time);
                    },
                    Qt::QueuedConnection);
                return {};
              });
}

void MatchController::setNoise(const sim::NoiseParameters& noise) {
  postChecked(tr("The noise stays as it was"),
              [noise](link::SimulatedMatch& match) { return match.simulation().setNoise(noise); });
}

void MatchController::setRigidBody(const sim::RigidBodySettings& settings) {
  postChecked(tr("The physics stays as it was"), [settings](link::SimulatedMatch& match) {
    return match.simulation().setRigidBody(settings);
  });
}

void MatchController::setPhysics(const QString& model) {
  link::Scenario moment = currentMoment();
  moment.settings.physics = model.toStdString();
  open(moment, m_paused);
}

void MatchController::setBehaviour(RobotId id, const QString& behaviour) {
  const auto known = m_robots.find(id);
  if (known == m_robots.end()) return;
  known->second.behaviour = behaviour.toStdString();
  postChecked(tr("%1 keeps its behaviour").arg(robotName(known->second.identity)),
              [id, name = behaviour.toStdString()](link::SimulatedMatch& match) {
                return match.setBehaviour(id, name);
              });
}

void MatchController::restartProcesses(RobotId id) {
  const auto known = m_robots.find(id);
  if (known == m_robots.end()) return;
  setBehaviour(id, QString::fromStdString(known->second.behaviour));
}

void MatchController::stopProcesses(RobotId id) {
  post([id](link::SimulatedMatch& match) { match.supervisor().stop(id); });
}

void MatchController::setClockRunning(bool running) {
  post([running](link::SimulatedMatch& match) { match.simulation().setClockRunning(running); });
}

void MatchController::resetScore() {
  post([](link::SimulatedMatch& match) {
    match.simulation().setScore({});
    match.simulation().editState().clockTicks = 0;
  });
}

}  // namespace pitchboard::ui
