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
  m_age.start();
}

void PlacementCommand::redo() {
  m_roster->place(m_placements, false);
}
void PlacementCommand::undo() {
  m_roster->place(m_placements, true);
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

BallCommand::BallCommand(MatchRoster* roster, Point from, Point to)
    : m_roster(roster), m_from(from), m_to(to) {
  setText(QStringLiteral("Move the ball"));
  m_age.start();
}

void BallCommand::redo() {
  m_roster->placeBall(m_to);
}
void BallCommand::undo() {
  m_roster->placeBall(m_from);
}

bool BallCommand::mergeWith(const QUndoCommand* other) {
  if (m_age.elapsed() > mergeMilliseconds) return false;
  m_to = static_cast<const BallCommand&>(*other).m_to;
  m_age.restart();
  return true;
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

TeamCommand::TeamCommand(MatchRoster* roster, std::vector<sim::RobotIdentity> before,
                         std::vector<sim::RobotIdentity> after)
    : m_roster(roster), m_before(std::move(before)), m_after(std::move(after)) {
  const std::string_view team = info(m_after.front().team).name;
  setText(QStringLiteral("Put %1 in team %2")
              .arg(subject(m_before.size(), robotName(m_before.front())),
                   QString::fromUtf8(team.data(), static_cast<qsizetype>(team.size()))));
}

void TeamCommand::redo() {
  m_roster->changeIdentities(m_after);
}
void TeamCommand::undo() {
  m_roster->changeIdentities(m_before);
}

void RemoveRobotsCommand::undo() {
  for (const link::ScenarioRobot& robot : m_robots) m_roster->insert(robot);
}

}  // namespace pitchboard::ui
