// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit_commands.h"

#include <QCoreApplication>

#include <ui/base/robot_words.h>

#include "match_roster.h"

namespace pitchboard::ui {
namespace {

constexpr qint64 mergeMilliseconds = 1000;

QString subject(std::size_t count, const QString& one) {
  return count == 1 ? one : QStringLiteral("%1 robots").arg(count);
}

QString nameIn(const MatchRoster& roster, RobotId id) {
  const link::ScenarioRobot* robot = roster.robot(id);
  return robot != nullptr ? robotName(robot->identity) : QStringLiteral("robot");
}

}  // namespace

PlacementCommand::PlacementCommand(MatchRoster* roster, std::vector<RobotPlacement> placements)
    : m_roster(roster), m_placements(std::move(placements)) {
  setText(QStringLiteral("Move ") +
          subject(m_placements.size(), nameIn(*roster, m_placements.front().id)));
}

void PlacementCommand::redo() {
  m_roster->place(m_placements, false);
}
void PlacementCommand::undo() {
  m_roster->place(m_placements, true);
}

bool PlacementCommand::continueWith(const PlacementCommand& later) {
  if (later.m_placements.size() != m_placements.size()) return false;
  for (std::size_t i = 0; i < m_placements.size(); ++i) {
    if (later.m_placements[i].id != m_placements[i].id) return false;
  }
  for (std::size_t i = 0; i < m_placements.size(); ++i) {
    m_placements[i].to = later.m_placements[i].to;
  }
  return true;
}

NudgeCommand::NudgeCommand(MatchRoster* roster, std::vector<RobotPlacement> placements)
    : PlacementCommand(roster, std::move(placements)) {
  m_age.start();
}

bool NudgeCommand::mergeWith(const QUndoCommand* other) {
  if (m_age.elapsed() > mergeMilliseconds) return false;
  m_age.restart();
  return continueWith(static_cast<const NudgeCommand&>(*other));
}

BallCommand::BallCommand(MatchRoster* roster, Point from, Point to, Velocity velocity)
    : m_roster(roster), m_from(from), m_to(to), m_velocity(velocity) {
  setText(velocity == Velocity{} ? QStringLiteral("Move the ball")
                                 : QStringLiteral("Kick the ball"));
}

void BallCommand::redo() {
  m_roster->placeBall(m_to, m_velocity);
}
void BallCommand::undo() {
  m_roster->placeBall(m_from);
}

AddRobotCommand::AddRobotCommand(MatchRoster* roster, link::ScenarioRobot robot)
    : m_roster(roster), m_robot(std::move(robot)) {
  setText(QStringLiteral("Add ") + robotName(m_robot.identity));
}

void AddRobotCommand::redo() {
  m_roster->insert(m_robot);
}
void AddRobotCommand::undo() {
  m_roster->erase(m_robot.identity.id);
}

RemoveRobotsCommand::RemoveRobotsCommand(MatchRoster* roster,
                                         std::vector<link::ScenarioRobot> robots)
    : m_roster(roster), m_robots(std::move(robots)) {
  setText(QStringLiteral("Remove ") +
          subject(m_robots.size(), robotName(m_robots.front().identity)));
}

void RemoveRobotsCommand::redo() {
  for (const link::ScenarioRobot& robot : m_robots) m_roster->erase(robot.identity.id);
}

IdentityCommand::IdentityCommand(MatchRoster* roster, std::vector<sim::RobotIdentity> before,
                                 std::vector<sim::RobotIdentity> after, const QString& words)
    : m_roster(roster), m_before(std::move(before)), m_after(std::move(after)) {
  setText(words);
}

void IdentityCommand::redo() {
  m_roster->changeIdentities(m_after);
}
void IdentityCommand::undo() {
  m_roster->changeIdentities(m_before);
}

BehaviourCommand::BehaviourCommand(MatchRoster* roster, std::vector<Change> changes)
    : m_roster(roster), m_changes(std::move(changes)) {
  setText(QStringLiteral("Make %1 %2")
              .arg(subject(m_changes.size(), nameIn(*roster, m_changes.front().id)),
                   QString::fromStdString(m_changes.front().after)));
}

void BehaviourCommand::redo() {
  for (const Change& change : m_changes) m_roster->setBehaviour(change.id, change.after);
}
void BehaviourCommand::undo() {
  for (const Change& change : m_changes) m_roster->setBehaviour(change.id, change.before);
}

ModelCommand::ModelCommand(MatchRoster* roster, Models before, Models after)
    : m_roster(roster), m_before(std::move(before)), m_after(std::move(after)) {
  setText(QStringLiteral("Change the model of %1")
              .arg(subject(m_after.size(), nameIn(*roster, m_after.front().first))));
  m_age.start();
}

void ModelCommand::redo() {
  m_roster->setModels(m_after);
}
void ModelCommand::undo() {
  m_roster->setModels(m_before);
}

bool ModelCommand::mergeWith(const QUndoCommand* other) {
  const auto& later = static_cast<const ModelCommand&>(*other);
  if (m_age.elapsed() > mergeMilliseconds || later.m_after.size() != m_after.size()) return false;
  for (std::size_t i = 0; i < m_after.size(); ++i) {
    if (later.m_after[i].first != m_after[i].first) return false;
  }
  m_after = later.m_after;
  m_age.restart();
  return true;
}

PhysicsCommand::PhysicsCommand(MatchRoster* roster, std::string after)
    : m_roster(roster), m_before(roster->physics()), m_after(std::move(after)) {
  setText(QStringLiteral("Play with %1 physics").arg(QString::fromStdString(m_after)));
}

void PhysicsCommand::redo() {
  m_roster->setPhysics(m_after);
}
void PhysicsCommand::undo() {
  m_roster->setPhysics(m_before);
}

ReopenCommand::ReopenCommand(MatchEdits* edits, link::Scenario before, link::Scenario beginning,
                             link::Scenario after, const QString& words)
    : m_edits(edits),
      m_before(std::move(before)),
      m_beginning(std::move(beginning)),
      m_after(std::move(after)) {
  setText(words);
}

void ReopenCommand::redo() {
  m_edits->reopen(m_after, m_after);
}
void ReopenCommand::undo() {
  m_edits->reopen(m_before, m_beginning);
}

void RemoveRobotsCommand::undo() {
  for (const link::ScenarioRobot& robot : m_robots) m_roster->insert(robot);
}

}  // namespace pitchboard::ui
