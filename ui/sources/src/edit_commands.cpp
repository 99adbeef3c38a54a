// SPDX-License-Identifier: GPL-3.0-or-later
#include "edit_commands.h"

#include <QCoreApplication>

#include <ui/base/robot_words.h>

namespace pitchboard::ui {
namespace {

constexpr qint64 mergeMilliseconds = 1000;

QString subject(std::size_t count, const QString& one) {
  return count == 1 ? one : QStringLiteral("%1 robots").arg(count);
}

QString nameIn(const MatchController& controller, RobotId id) {
  const link::ScenarioRobot* robot = controller.robot(id);
  return robot != nullptr ? robotName(robot->identity) : QStringLiteral("robot");
}

}  // namespace

PlacementCommand::PlacementCommand(MatchController* controller,
                                   std::vector<RobotPlacement> placements)
    : m_controller(controller), m_placements(std::move(placements)) {
  setText(QStringLiteral("Move ") +
          subject(m_placements.size(), nameIn(*controller, m_placements.front().id)));
  m_age.start();
}

void PlacementCommand::redo() {
  m_controller->placeRobots(m_placements, false);
}
void PlacementCommand::undo() {
  m_controller->placeRobots(m_placements, true);
}

bool PlacementCommand::mergeWith(const QUndoCommand* other) {
  const auto& later = static_cast<const PlacementCommand&>(*other);
  if (m_age.elapsed() > mergeMilliseconds || later.m_placements.size() != m_placements.size()) {
    return false;
  }
  for (std::size_t i = 0; i < m_placements.size(); ++i) {
    if (later.m_placements[i].id != m_placements[i].id) return false;
  }
  for (std::size_t i = 0; i < m_placements.size(); ++i) {
    m_placements[i].to = later.m_placements[i].to;
  }
  m_age.restart();
  return true;
}

BallCommand::BallCommand(MatchController* controller, Point from, Point to)
    : m_controller(controller), m_from(from), m_to(to) {
  setText(QStringLiteral("Move the ball"));
  m_age.start();
}

void BallCommand::redo() {
  m_controller->placeBall(m_to);
}
void BallCommand::undo() {
  m_controller->placeBall(m_from);
}

bool BallCommand::mergeWith(const QUndoCommand* other) {
  if (m_age.elapsed() > mergeMilliseconds) return false;
  m_to = static_cast<const BallCommand&>(*other).m_to;
  m_age.restart();
  return true;
}

AddRobotCommand::AddRobotCommand(MatchController* controller, link::ScenarioRobot robot)
    : m_controller(controller), m_robot(std::move(robot)) {
  setText(QStringLiteral("Add ") + robotName(m_robot.identity));
}

void AddRobotCommand::redo() {
  m_controller->insertRobot(m_robot);
}
void AddRobotCommand::undo() {
  m_controller->eraseRobot(m_robot.identity.id);
}

RemoveRobotsCommand::RemoveRobotsCommand(MatchController* controller,
                                         std::vector<link::ScenarioRobot> robots)
    : m_controller(controller), m_robots(std::move(robots)) {
  setText(QStringLiteral("Remove ") +
          subject(m_robots.size(), robotName(m_robots.front().identity)));
}

void RemoveRobotsCommand::redo() {
  for (const link::ScenarioRobot& robot : m_robots) m_controller->eraseRobot(robot.identity.id);
}

TeamCommand::TeamCommand(MatchController* controller, std::vector<sim::RobotIdentity> before,
                         std::vector<sim::RobotIdentity> after)
    : m_controller(controller), m_before(std::move(before)), m_after(std::move(after)) {
  const std::string_view team = info(m_after.front().team).name;
  setText(QStringLiteral("Put %1 in team %2")
              .arg(subject(m_before.size(), robotName(m_before.front())),
                   QString::fromUtf8(team.data(), static_cast<qsizetype>(team.size()))));
}

void TeamCommand::redo() {
  m_controller->changeIdentities(m_after);
}
void TeamCommand::undo() {
  m_controller->changeIdentities(m_before);
}

void RemoveRobotsCommand::undo() {
  for (const link::ScenarioRobot& robot : m_robots) m_controller->insertRobot(robot);
}

}  // namespace pitchboard::ui
