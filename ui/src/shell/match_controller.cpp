// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/match_controller.h>

#include <QTimer>
#include <QUndoStack>
#include <algorithm>

#include "robot_words.h"

namespace pitchboard::ui {

MatchController::MatchController(link::MatchOptions options, QObject* parent)
    : QObject(parent),
      m_options(std::move(options)),
      m_timer(new QTimer(this)),
      m_undoStack(new QUndoStack(this)) {
  constexpr int displayMilliseconds = 16;
  constexpr int undoLimit = 1000;
  m_undoStack->setUndoLimit(undoLimit);
  m_timer->setTimerType(Qt::PreciseTimer);
  m_timer->setInterval(displayMilliseconds);
  connect(m_timer, &QTimer::timeout, this, &MatchController::poll);
}

// The runner's commands post back to this object: it must be gone while we are still whole.
MatchController::~MatchController() { m_runner.reset(); }

Result<std::unique_ptr<link::MatchRunner>> MatchController::startRunner(
    const link::Scenario& scenario, bool paused) {
  m_cognition = m_options.cognition;
  auto runner = link::MatchRunner::start(scenario, m_options, paused);
  if (runner || m_options.cognition == link::Cognition::Inline) return runner;

  link::MatchOptions inside = m_options;
  inside.cognition = link::Cognition::Inline;
  inside.systemV = false;
  auto second = link::MatchRunner::start(scenario, inside, paused);
  if (!second) return second;
  m_cognition = link::Cognition::Inline;
  emit errorOccurred(tr("Separate robot processes cannot run: %1. The robots decide inside the "
                        "studio instead, and other programs cannot see their blackboards. Close "
                        "the other program, then restart the match.")
                         .arg(QString::fromStdString(runner.error().text())));
  return second;
}

void MatchController::close() {
  m_timer->stop();
  m_runner.reset();
  m_frame.reset();
  m_undoStack->clear();
}

void MatchController::open(const link::Scenario& scenario, bool paused) {
  close();
  m_robots.clear();
  m_scenario = scenario;
  m_paused = paused;
  for (const link::ScenarioRobot& entry : scenario.robots) {
    m_robots.emplace(entry.identity.id, entry);
  }
  auto runner = startRunner(m_scenario, paused);
  if (runner) {
    m_runner = std::move(*runner);
    if (m_speed != 1.0) m_runner->setSpeed(m_speed);
    m_timer->start();
  }
  emit scenarioChanged();
  emit transportChanged();
  if (!runner) {
    emit errorOccurred(tr("The match cannot be played: %1")
                           .arg(QString::fromStdString(runner.error().text())));
    return;
  }
  poll();
}

void MatchController::poll() {
  if (!m_runner) return;
  if (FramePtr frame = m_runner->latest(m_frame ? m_frame->serial : 0)) {
    m_frame = std::move(frame);
    emit frameReceived(m_frame);
  }
  // A receiver may have opened another match.
  if (!m_runner) return;
  if (const auto events = m_runner->takeEvents(); !events.empty()) emit eventsReceived(events);
  if (!m_runner) return;
  if (const auto lines = m_runner->takeLog(); !lines.empty()) emit logReceived(lines);
}

void MatchController::setPaused(bool paused) {
  if (!m_runner) return;
  m_paused = paused;
  m_runner->setPaused(paused);
  emit transportChanged();
}

void MatchController::stepOnce() {
  if (!m_runner) return;
  m_paused = true;
  m_runner->stepOnce();
  emit transportChanged();
}

void MatchController::setSpeed(double timesRealTime) {
  m_speed = timesRealTime;
  if (m_runner) m_runner->setSpeed(timesRealTime);
  emit transportChanged();
}

void MatchController::restart() {
  const link::Scenario scenario = m_scenario;
  open(scenario, m_paused);
}

link::Scenario MatchController::currentMoment() {
  link::Scenario moment = m_scenario;
  if (m_runner) {
    m_runner->execute([&moment](link::SimulatedMatch& match) { moment = match.toScenario(); });
  }
  return moment;
}

std::uint64_t MatchController::stateHash() {
  std::uint64_t hash = 0;
  if (m_runner) {
    m_runner->execute([&hash](link::SimulatedMatch& match) { hash = match.simulation().hash(); });
  }
  return hash;
}

const link::ScenarioRobot* MatchController::robot(RobotId id) const {
  const auto found = m_robots.find(id);
  return found != m_robots.end() ? &found->second : nullptr;
}

void MatchController::postChecked(const QString& whatFailed,
                                  std::function<Result<void>(link::SimulatedMatch&)> command,
                                  std::function<void()> onFailure) {
  if (!m_runner) return;
  m_runner->post([this, whatFailed, command = std::move(command),
                  onFailure = std::move(onFailure)](link::SimulatedMatch& match) {
    const Result<void> done = command(match);
    if (done) return;
    const QString sentence = whatFailed + QStringLiteral(": ") +
                             QString::fromStdString(done.error().text());
    QMetaObject::invokeMethod(this, [this, sentence, onFailure] {
      if (onFailure) onFailure();
      emit errorOccurred(sentence);
    }, Qt::QueuedConnection);
  });
}

}  // namespace pitchboard::ui
