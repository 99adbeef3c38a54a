// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_edits.h>

#include <QUndoStack>
#include <algorithm>
#include <set>
#include <utility>

#include <ui/base/robot_words.h>

#include "edit_commands.h"
#include "match_roster.h"

namespace pitchboard::ui {
namespace {

template <class Used>
int smallestFree(const Used& used) {
  int number = 1;
  while (used.count(number) != 0) ++number;
  return number;
}

}  // namespace

MatchEdits::MatchEdits(MatchController* match)
    : QObject(match),
      m_match(match),
      m_roster(std::make_unique<MatchRoster>(match)),
      m_undoStack(new QUndoStack(this)) {
  constexpr int undoLimit = 1000;
  m_undoStack->setUndoLimit(undoLimit);
  connect(match, &MatchController::scenarioChanged, this, [this] {
    if (!m_reopening) m_undoStack->clear();
    m_roster->begin(m_match->isOpening() ? m_match->scenario() : link::Scenario{});
  });
  m_roster->whenModelsChange([this] { emit modelsChanged(); });
  m_roster->whenPhysicsChanges([this] { emit physicsChanged(); });
}

MatchEdits::~MatchEdits() = default;

const link::ScenarioRobot* MatchEdits::robot(RobotId id) const {
  return m_roster->robot(id);
}

void MatchEdits::setLocked(bool on) {
  if (on == m_locked) return;
  m_locked = on;
  m_toldLocked = false;
  emit lockedChanged(on);
}

const std::string& MatchEdits::physics() const {
  return m_roster->physics();
}

QString MatchEdits::lockedText() {
  return QStringLiteral("You are viewing the past. Press Now to return to the match.");
}

bool MatchEdits::allowsChange() {
  if (m_locked && !std::exchange(m_toldLocked, true)) emit failed(lockedText());
  return !m_locked;
}

void MatchEdits::push(std::unique_ptr<QUndoCommand> command) {
  if (m_match->isOpen() && allowsChange()) m_undoStack->push(command.release());
}

void MatchEdits::pushTogether(const QString& words, const std::function<void()>& steps) {
  if (!m_match->isOpen() || !allowsChange()) return;
  m_undoStack->beginMacro(words);
  steps();
  m_undoStack->endMacro();
}

void MatchEdits::order(MatchOrder change) {
  if (allowsChange()) m_match->post(std::move(change));
}

void MatchEdits::order(link::MatchRunner::Command change) {
  if (allowsChange()) m_match->post(std::move(change));
}

void MatchEdits::adopt(const link::Moment& moment) {
  m_undoStack->clear();
  m_roster->adopt(moment);
}

void MatchEdits::moveRobots(const std::vector<RobotPlacement>& placements) {
  if (!placements.empty()) push(std::make_unique<PlacementCommand>(m_roster.get(), placements));
}

void MatchEdits::nudgeRobots(const std::vector<RobotPlacement>& placements) {
  if (!placements.empty()) push(std::make_unique<NudgeCommand>(m_roster.get(), placements));
}

void MatchEdits::moveBall(Point from, Point to, Velocity velocity) {
  push(std::make_unique<BallCommand>(m_roster.get(), from, to, velocity));
}

void MatchEdits::previewRobots(const std::vector<RobotPlacement>& placements) {
  if (allowsChange()) m_roster->place(placements, false);
}

void MatchEdits::previewBall(Point position) {
  if (allowsChange()) m_roster->placeBall(position);
}

void MatchEdits::addRobot(TeamColor team, const Pose& pose, std::optional<int> number) {
  if (!m_match->isOpen()) return;
  std::set<int> ids, numbers;
  for (const auto& [id, entry] : m_roster->robots()) {
    ids.insert(id.value);
    if (entry.identity.team == team) numbers.insert(entry.identity.number);
  }
  if (static_cast<int>(ids.size()) >= sim::Simulation::maxRobots) {
    emit failed(QStringLiteral("No more than %1 robots fit on a field. Remove one first.")
                    .arg(sim::Simulation::maxRobots));
    return;
  }
  link::ScenarioRobot entry;
  entry.identity = {RobotId{smallestFree(ids)}, team, number.value_or(smallestFree(numbers)),
                    info(team).facesLeft};
  entry.pose = pose;
  // Of the kind of its team-mates, else of that of anybody.
  for (const auto& [id, known] : m_roster->robots()) {
    if (known.identity.team != team) continue;
    entry.model = known.model;
    break;
  }
  if (numbers.count(entry.identity.number) != 0) {
    emit failed(QStringLiteral("%1 is on the field already. Choose another number.")
                    .arg(robotName(entry.identity)));
    return;
  }
  push(std::make_unique<AddRobotCommand>(m_roster.get(), entry));
}

void MatchEdits::removeRobots(const std::vector<RobotId>& ids) {
  const FramePtr newest = m_match->frame();
  std::vector<link::ScenarioRobot> leaving;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr) continue;
    leaving.push_back(*known);
    if (!newest) continue;
    if (const link::RobotFrame* seen = newest->robot(id)) leaving.back().pose = seen->pose;
  }
  if (!leaving.empty())
    push(std::make_unique<RemoveRobotsCommand>(m_roster.get(), std::move(leaving)));
}

void MatchEdits::setTeam(const std::vector<RobotId>& ids, TeamColor team) {
  if (!m_match->isOpen()) return;
  std::set<int> numbers;
  for (const auto& [id, entry] : m_roster->robots()) {
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
    const std::string_view name = info(team).name;
    const QString words =
        QStringLiteral("Put %1 in team %2")
            .arg(before.size() == 1 ? robotName(before.front())
                                    : QStringLiteral("%1 robots").arg(before.size()),
                 QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())));
    m_undoStack->push(
        new IdentityCommand(m_roster.get(), std::move(before), std::move(after), words));
  }
}

void MatchEdits::setNumber(RobotId id, int number) {
  const link::ScenarioRobot* known = robot(id);
  if (known == nullptr || known->identity.number == number) return;
  sim::RobotIdentity after = known->identity;
  after.number = number;
  for (const auto& [other, entry] : m_roster->robots()) {
    if (other == id || entry.identity.team != after.team || entry.identity.number != number) {
      continue;
    }
    emit failed(QStringLiteral("%1 is on the field already. Choose another number.")
                    .arg(robotName(entry.identity)));
    return;
  }
  push(std::make_unique<IdentityCommand>(
      m_roster.get(), std::vector{known->identity}, std::vector{after},
      QStringLiteral("Make %1 %2").arg(robotName(known->identity), robotName(after))));
}

void MatchEdits::setBehaviour(const std::vector<RobotId>& ids, const QString& behaviour) {
  std::vector<BehaviourCommand::Change> changes;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr || known->behaviour == behaviour.toStdString()) continue;
    changes.push_back({id, known->behaviour, behaviour.toStdString()});
  }
  if (!changes.empty()) {
    push(std::make_unique<BehaviourCommand>(m_roster.get(), std::move(changes)));
  }
}

void MatchEdits::setModel(const std::vector<RobotId>& ids, const sim::RobotModel& model) {
  ModelCommand::Models before, after;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr || known->model == model) continue;
    before.emplace_back(id, known->model);
    after.emplace_back(id, model);
  }
  if (!after.empty()) {
    push(std::make_unique<ModelCommand>(m_roster.get(), std::move(before), std::move(after)));
  }
}

void MatchEdits::load(const link::Scenario& scenario, const QString& words) {
  if (!allowsChange()) return;
  if (!m_match->isOpen()) {
    m_match->open(scenario, m_match->isPaused());
    return;
  }
  push(std::make_unique<ReopenCommand>(this, m_match->currentMoment(), m_match->beginning(),
                                       scenario, words));
}

void MatchEdits::reopen(const link::Scenario& scenario, const link::Scenario& beginning) {
  m_reopening = true;
  m_match->openMoment(scenario, beginning, m_match->isPaused());
  m_reopening = false;
}

void MatchEdits::commandAction(RobotId id, int actionA, std::optional<int> actionB) {
  order([id, actionA, actionB](link::SimulatedMatch& match) {
    link::Blackboard* board = match.blackboard(id);
    if (board == nullptr) return;
    // B first: control reads it in the moment it sees a new A.
    if (actionB) board->write(match.variables().decisionActionB, *actionB);
    board->write(match.variables().decisionActionA, actionA);
  });
}

void MatchEdits::commandSearch(RobotId id, bool on) {
  order([id, on](link::SimulatedMatch& match) {
    if (link::Blackboard* board = match.blackboard(id)) {
      board->write(match.variables().decisionSearchOn, on ? 1 : 0);
    }
  });
}

void MatchEdits::writeVariable(RobotId id, const QString& name, double value) {
  const link::Variable* variable = m_match->catalog().find(name.toStdString());
  const QString notWritten = QStringLiteral("%1 is not written").arg(name);
  if (variable == nullptr) {
    emit failed(QStringLiteral("%1: this match's catalog has no such variable.").arg(notWritten));
    return;
  }
  const auto time = std::make_shared<double>();  // of the tick after which it was written, s
  order({notWritten,
         [id, value, type = variable->type, index = variable->index,
          time](link::SimulatedMatch& match) -> Result<void> {
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
           *time = static_cast<double>(state.tick) / state.settings.tickRate;
           return {};
         },
         {},
         [this, id, name, time] { emit variableWritten(id, name, *time); }});
}

void MatchEdits::setNoise(const sim::NoiseParameters& noise) {
  order({QStringLiteral("The noise stays as it was"),
         [noise](link::SimulatedMatch& match) { return match.simulation().setNoise(noise); }});
}

void MatchEdits::setRigidBody(const sim::RigidBodySettings& settings) {
  order({QStringLiteral("The physics stays as it was"), [settings](link::SimulatedMatch& match) {
           return match.simulation().setRigidBody(settings);
         }});
}

void MatchEdits::setPhysics(const QString& model) {
  if (model.toStdString() == physics()) return;
  push(std::make_unique<PhysicsCommand>(m_roster.get(), model.toStdString()));
}

void MatchEdits::setRuntime(RobotId id, const link::RuntimeChoice& choice) {
  if (allowsChange()) m_roster->setRuntime(id, choice);
}

void MatchEdits::startProcess(int process) {
  order([process](link::SimulatedMatch& match) {
    match.processes().start(process, std::chrono::steady_clock::now());
  });
}

void MatchEdits::stopProcess(int process) {
  order([process](link::SimulatedMatch& match) { match.processes().stop(process); });
}

void MatchEdits::restartProcess(int process) {
  order([process](link::SimulatedMatch& match) {
    match.processes().restart(process, std::chrono::steady_clock::now());
  });
}

void MatchEdits::killProcess(int process) {
  order([process](link::SimulatedMatch& match) { match.processes().kill(process); });
}

void MatchEdits::setClockRunning(bool running) {
  order([running](link::SimulatedMatch& match) { match.simulation().setClockRunning(running); });
}

void MatchEdits::resetScore() {
  order([](link::SimulatedMatch& match) {
    match.simulation().setScore({});
    match.simulation().editState().clockTicks = 0;
  });
}

}  // namespace pitchboard::ui
