// SPDX-License-Identifier: GPL-3.0-or-later
// The recent past of a match: shown again, watched, gone on from.
#include <QUndoStack>
#include <algorithm>
#include <cmath>

#include <robotlink/session/moment_reader.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {

FramePtr MatchController::frameAt(double time) const {
  const auto rows = series();
  if (!rows || !m_frame || !rows->range()) return nullptr;
  if (!m_past) {
    link::FrameBackdrop backdrop;
    backdrop.field = m_frame->field;
    backdrop.noise = m_frame->noise;
    backdrop.physics = m_frame->physics;
    backdrop.seed = m_frame->seed;
    backdrop.tickRate = m_frame->tickRate;
    m_past = std::make_unique<link::RecordedFrames>(std::move(backdrop));
  }
  auto past = std::make_shared<link::MatchFrame>(m_past->frameAt(*rows, time));
  if (past->robots.empty() && !m_frame->robots.empty() && time < rows->range()->begin) {
    return nullptr;
  }
  return past;
}

bool MatchController::observe(std::shared_ptr<link::TickObserver> observer) {
  if (!m_runner) return false;
  m_runner->observe(std::move(observer));
  return true;
}

void MatchController::stopObserving(const std::shared_ptr<link::TickObserver>& observer) {
  if (m_runner) m_runner->stopObserving(observer);
}

void MatchController::continueFrom(double time) {
  const auto rows = series();
  if (!m_runner || !m_archive || !rows || !m_frame) return;
  const auto tick =
      static_cast<std::uint64_t>(std::llround(std::max(time, 0.0) * m_frame->tickRate));
  setPaused(true);
  auto moment = link::momentFromMemory(*m_archive, *rows, tick, *m_catalog);
  if (!moment) {
    emit errorOccurred(tr("The match cannot be continued from this moment: %1")
                           .arg(QString::fromStdString(moment.error().text())));
    return;
  }
  std::map<RobotId, link::ScenarioRobot> robots;
  for (const sim::RobotIdentity& identity : moment->state.robots) {
    link::ScenarioRobot entry;
    if (const auto known = m_robots.find(identity.id); known != m_robots.end()) {
      entry = known->second;
    }
    entry.identity = identity;
    if (const link::MomentRobot* of = moment->robot(identity.id)) entry.behaviour = of->behaviour;
    robots.emplace(identity.id, entry);
  }
  m_robots = std::move(robots);
  m_undoStack->clear();
  postChecked(
      tr("The match cannot be continued from this moment"),
      [moment = std::move(*moment)](link::SimulatedMatch& match) { return match.reenter(moment); });
}

}  // namespace pitchboard::ui
