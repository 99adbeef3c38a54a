// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_edits.h>

#include <QUndoStack>
#include <algorithm>
#include <utility>

#include <base/try.h>
#include <ui/base/robot_text.h>
#include <ui/sources/retired_match.h>

namespace pitchboard::ui {
namespace {

/// Tells edits of these robots from those of others.
template <class Items, class Id>
QString mergeKeyOf(const QString& what, const Items& items, Id idOf) {
  QString key = what;
  for (const auto& item : items) key += QStringLiteral(" %1").arg(idOf(item).value);
  return key;
}

}  // namespace

/// What of a robot can be changed, and how the match is told.
template <class Value>
struct MatchEdits::Field {
  Value link::ScenarioRobot::*member;
  Result<void> (*carryOut)(link::SimulatedMatch& match, RobotId id, const Value& value);
  const char* whatFailed;
  link::Changed changes;
};

const MatchEdits::Field<sim::RobotIdentity> MatchEdits::identityField{
    &link::ScenarioRobot::identity,
    [](link::SimulatedMatch& match, RobotId, const sim::RobotIdentity& identity) {
      return match.robots().setIdentity(identity);
    },
    "Could not change the team or number of %1", link::Changed::Yes};
const MatchEdits::Field<std::string> MatchEdits::behaviourField{
    &link::ScenarioRobot::behaviour,
    [](link::SimulatedMatch& match, RobotId id, const std::string& behaviour) {
      return match.robots().setBehaviour(id, behaviour);
    },
    "Could not change the behaviour of %1", link::Changed::No};
const MatchEdits::Field<sim::RobotModel> MatchEdits::modelField{
    &link::ScenarioRobot::model,
    [](link::SimulatedMatch& match, RobotId id, const sim::RobotModel& model) {
      return match.robots().setModel(id, model);
    },
    "Could not change the model of %1", link::Changed::Yes};
const MatchEdits::Field<link::RuntimeChoice> MatchEdits::runtimeField{
    &link::ScenarioRobot::runtime,
    [](link::SimulatedMatch& match, RobotId id, const link::RuntimeChoice& choice) {
      return match.robots().setRuntime(id, choice);
    },
    "Could not change the runtime of %1", link::Changed::No};

MatchEdits::MatchEdits(MatchController* match)
    : QObject(match), m_match(match), m_undoStack(new QUndoStack(this)) {
  constexpr int undoLimit = 1000;
  m_undoStack->setUndoLimit(undoLimit);
  connect(m_undoStack, &QUndoStack::indexChanged, this, [this] {
    const auto* last = lastEdit();
    if (last == nullptr || last->mergeKey() != m_gesture.mergeKey()) m_gesture = {};
    dropRefused();
  });
  connect(match, &MatchController::scenarioChanged, this, [this] {
    if (!m_replacing) m_undoStack->clear();
    const link::Scenario scenario = m_match->isOpening() ? m_match->scenario() : link::Scenario{};
    m_robots.clear();
    for (const link::ScenarioRobot& entry : scenario.robots) {
      m_robots.emplace(entry.identity.id, entry);
    }
    m_advisors = scenario.advisors;
    takePhysics(scenario.settings.physics);
  });
}

const link::ScenarioRobot* MatchEdits::robot(RobotId id) const {
  const auto found = m_robots.find(id);
  return found != m_robots.end() ? &found->second : nullptr;
}

void MatchEdits::setLocked(bool on) {
  if (on == m_locked) return;
  m_locked = on;
  m_reportedLocked = false;
  emit lockedChanged(on);
}

QString MatchEdits::lockedText() {
  return QStringLiteral("You are viewing the past. Press Now to return to the match.");
}

bool MatchEdits::allowsChange() {
  if (m_locked && !std::exchange(m_reportedLocked, true)) emit failed(lockedText());
  return !m_locked;
}

void MatchEdits::perform(Edit edit) {
  if (m_match->isOpen() && allowsChange()) push(std::move(edit));
}

struct MatchEdits::Attempt {
  int orders = 0;  // that were not refused so far
  std::shared_ptr<bool> refused;
};

void MatchEdits::push(Edit edit) {
  const auto refused = std::make_shared<bool>(false);
  edit.refused = refused;
  edit.redo = [this, refused, redo = std::move(edit.redo)] {
    m_attempt = std::make_shared<Attempt>(Attempt{0, refused});
    redo();
    m_attempt.reset();
  };
  m_undoStack->push(new EditCommand(std::move(edit)));
}

void MatchEdits::post(MatchOrder order) {
  if (m_attempt) {
    ++m_attempt->orders;
    order.onFailure = [this, attempt = m_attempt, then = std::move(order.onFailure)] {
      if (then) then();
      if (--attempt->orders > 0) return;
      *attempt->refused = true;
      dropRefused();
    };
  }
  m_match->post(std::move(order));
}

const EditCommand* MatchEdits::lastEdit() const {
  return static_cast<const EditCommand*>(m_undoStack->command(m_undoStack->index() - 1));
}

void MatchEdits::dropRefused() {
  const EditCommand* last = lastEdit();
  if (last != nullptr && last->isRefused()) m_undoStack->undo();
}

void MatchEdits::performOrder(const QString& text, const QString& whatFailed,
                              std::vector<EditStep> steps, const QString& mergeKey) {
  if (!(m_match->isOpen() || m_match->isOpening()) || !allowsChange()) return;
  struct Order {
    std::vector<EditStep> steps;
    bool carriedOut = false;  // the match's thread; a redo may be refused
  };
  const auto all = std::make_shared<Order>(Order{std::move(steps)});
  MatchOrder redo{whatFailed, [all](link::SimulatedMatch& match) -> Result<void> {
                    all->carriedOut = false;
                    for (auto step = all->steps.begin(); step != all->steps.end(); ++step) {
                      auto done = step->redo(match);
                      if (done) continue;
                      while (step != all->steps.begin()) (void)(--step)->undo(match);
                      return done;
                    }
                    all->carriedOut = true;
                    return {};
                  }};
  const MatchOrder undo{QStringLiteral("Could not undo “%1”").arg(text),
                        [all](link::SimulatedMatch& match) -> Result<void> {
                          if (!all->carriedOut) return {};
                          for (auto step = all->steps.rbegin(); step != all->steps.rend(); ++step) {
                            if (auto undone = step->undo(match); !undone) return undone;
                          }
                          return {};
                        }};
  const MatchOrder again = redo;
  redo.onSuccess = [this, text, again, undo, mergeKey] {
    push({text, [this, again] { order(again); }, [this, undo] { order(undo); }, mergeKey, true});
  };
  m_match->post(std::move(redo));
}

void MatchEdits::order(MatchOrder change) {
  if (allowsChange()) post(std::move(change));
}

void MatchEdits::order(link::MatchRunner::Command change) {
  if (allowsChange()) m_match->post(std::move(change));
}

void MatchEdits::adopt(const link::Moment& moment) {
  m_undoStack->clear();
  std::map<RobotId, link::ScenarioRobot> robots;
  for (std::size_t i = 0; i < moment.state.robots.size(); ++i) {
    const sim::RobotIdentity& identity = moment.state.robots[i];
    link::ScenarioRobot entry;
    if (const link::ScenarioRobot* known = robot(identity.id)) entry = *known;
    entry.identity = identity;
    entry.model = moment.state.models[i];
    if (const link::MomentRobot* of = moment.robot(identity.id)) entry.behaviour = of->behaviour;
    robots.emplace(identity.id, entry);
  }
  m_robots = std::move(robots);
  takePhysics(moment.state.settings.physics);
}

template <class Items>
QString MatchEdits::subjectOf(const Items& items, RobotId first) const {
  if (items.size() != 1) return QStringLiteral("%1 robots").arg(items.size());
  const link::ScenarioRobot* known = robot(first);
  return known != nullptr ? robotName(known->identity) : QStringLiteral("robot");
}

template <class Value>
void MatchEdits::set(const Field<Value>& field, const Values<Value>& values) {
  for (const auto& [id, value] : values) {
    const auto known = m_robots.find(id);
    if (known == m_robots.end()) continue;
    const QString name = robotName(known->second.identity);
    const Value before = std::exchange(known->second.*field.member, value);
    post({QString::fromUtf8(field.whatFailed).arg(name),
          [carryOut = field.carryOut, id = id, value = value](link::SimulatedMatch& match) {
            return carryOut(match, id, value);
          },
          [this, member = field.member, id = id, before] {
            const auto still = m_robots.find(id);
            if (still != m_robots.end()) still->second.*member = before;
            emit robotsChanged();
          },
          {},
          field.changes});
  }
  emit robotsChanged();
}

template <class Value>
void MatchEdits::change(const Field<Value>& field, Values<Value> values, const QString& text,
                        const QString& mergeKey) {
  std::erase_if(values, [&](const auto& wanted) {
    const link::ScenarioRobot* known = robot(wanted.first);
    return known == nullptr || known->*field.member == wanted.second;
  });
  if (values.empty()) return;
  Values<Value> before;
  for (const auto& [id, value] : values) before.emplace_back(id, robot(id)->*field.member);
  const QString who = subjectOf(values, values.front().first);
  const QString key =
      mergeKey.isEmpty()
          ? mergeKey
          : mergeKeyOf(mergeKey, values, [](const auto& wanted) { return wanted.first; });
  perform({text.arg(who), [this, &field, values = std::move(values)] { set(field, values); },
           [this, &field, before = std::move(before)] { set(field, before); }, key});
}

void MatchEdits::placeRobots(const std::vector<RobotPlacement>& placements,
                             Pose RobotPlacement::*where) {
  m_match->post([placements, where](link::SimulatedMatch& match) {
    // A robot that left meanwhile has nothing to be placed.
    for (const RobotPlacement& placement : placements) {
      (void)match.simulation().placeRobot(placement.id, placement.*where);
    }
    return link::Changed::Yes;
  });
}

void MatchEdits::performPlacements(const std::vector<RobotPlacement>& placements,
                                   const QString& mergeKey) {
  if (placements.empty()) return;
  perform({QStringLiteral("Move ") + subjectOf(placements, placements.front().id),
           [this, placements] { placeRobots(placements, &RobotPlacement::to); },
           [this, placements] { placeRobots(placements, &RobotPlacement::from); }, mergeKey});
}

void MatchEdits::moveRobots(const std::vector<RobotPlacement>& placements) {
  performPlacements(placements, {});
}

void MatchEdits::nudgeRobots(const std::vector<RobotPlacement>& placements) {
  performPlacements(placements,
                    mergeKeyOf(QStringLiteral("nudge"), placements,
                               [](const RobotPlacement& placement) { return placement.id; }));
}

void MatchEdits::previewRobots(const std::vector<RobotPlacement>& placements) {
  if (allowsChange()) placeRobots(placements, &RobotPlacement::to);
}

void MatchEdits::placeBall(Point position, Velocity velocity) {
  post({QStringLiteral("Could not place the ball"),
        [position, velocity](link::SimulatedMatch& match) {
          return match.simulation().placeBall(position, velocity);
        }});
}

void MatchEdits::moveBall(Point from, Point to, Velocity velocity) {
  perform(
      {velocity == Velocity{} ? QStringLiteral("Move the ball") : QStringLiteral("Kick the ball"),
       [this, to, velocity] { placeBall(to, velocity); }, [this, from] { placeBall(from); }});
}

void MatchEdits::previewBall(Point position) {
  if (allowsChange()) placeBall(position);
}

void MatchEdits::insert(const link::ScenarioRobot& entry) {
  m_robots.insert_or_assign(entry.identity.id, entry);
  post({QStringLiteral("Could not add %1").arg(robotName(entry.identity)),
        [entry](link::SimulatedMatch& match) { return match.robots().add(entry); },
        [this, id = entry.identity.id] { m_robots.erase(id); }});
}

void MatchEdits::erase(RobotId id) {
  const link::ScenarioRobot* known = robot(id);
  const QString name = known ? robotName(known->identity) : QStringLiteral("The robot");
  m_robots.erase(id);
  post({QStringLiteral("Could not remove %1").arg(name),
        [id](link::SimulatedMatch& match) { return match.robots().remove(id); }});
}

int MatchEdits::freeNumber(TeamColor team, const std::vector<int>& taken) const {
  for (int number = 1;; ++number) {
    const auto wears = [&](const auto& entry) {
      return entry.second.identity.team == team && entry.second.identity.number == number;
    };
    if (std::ranges::none_of(m_robots, wears) && std::ranges::count(taken, number) == 0) {
      return number;
    }
  }
}

bool MatchEdits::wearsAnother(const sim::RobotIdentity& wanted) {
  for (const auto& [id, entry] : m_robots) {
    if (id == wanted.id || entry.identity.team != wanted.team ||
        entry.identity.number != wanted.number) {
      continue;
    }
    emit failed(QStringLiteral("%1 is already on the field. Choose another number.")
                    .arg(robotName(wanted)));
    return true;
  }
  return false;
}

void MatchEdits::addRobot(TeamColor team, const Pose& pose, std::optional<int> number) {
  if (!m_match->isOpen()) return;
  if (static_cast<int>(m_robots.size()) >= sim::Simulation::maxRobots) {
    emit failed(QStringLiteral("No more than %1 robots fit on a field. Remove one first.")
                    .arg(sim::Simulation::maxRobots));
    return;
  }
  RobotId id{1};
  while (m_robots.count(id) != 0) ++id.value;
  link::ScenarioRobot entry;
  entry.identity = {id, team, number.value_or(freeNumber(team)), info(team).facesLeft};
  entry.pose = pose;
  // Of the kind of its team-mates, else of that of anybody.
  const auto mate = std::ranges::find_if(
      m_robots, [team](const auto& known) { return known.second.identity.team == team; });
  if (mate != m_robots.end()) entry.model = mate->second.model;
  if (wearsAnother(entry.identity)) return;
  perform({QStringLiteral("Add ") + robotName(entry.identity), [this, entry] { insert(entry); },
           [this, id] { erase(id); }});
}

void MatchEdits::removeRobots(const std::vector<RobotId>& ids) {
  const FramePtr newest = m_match->frame();
  std::vector<link::ScenarioRobot> leaving;  // with the poses that they have
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr) continue;
    leaving.push_back(*known);
    const link::RobotFrame* seen = newest ? newest->robot(id) : nullptr;
    if (seen != nullptr) leaving.back().pose = seen->pose;
  }
  if (leaving.empty()) return;
  perform({QStringLiteral("Remove ") + subjectOf(leaving, leaving.front().identity.id),
           [this, leaving] {
             for (const link::ScenarioRobot& gone : leaving) erase(gone.identity.id);
           },
           [this, leaving] {
             for (const link::ScenarioRobot& gone : leaving) insert(gone);
           }});
}

void MatchEdits::setTeam(const std::vector<RobotId>& ids, TeamColor team) {
  Values<sim::RobotIdentity> after;
  std::vector<int> taken;
  for (const RobotId id : ids) {
    const link::ScenarioRobot* known = robot(id);
    if (known == nullptr || known->identity.team == team) continue;
    taken.push_back(freeNumber(team, taken));
    after.push_back({id, {id, team, taken.back(), info(team).facesLeft}});
  }
  const std::string_view name = info(team).name;
  change(identityField, std::move(after),
         QStringLiteral("Move %1 to team ") +
             QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())));
}

void MatchEdits::setNumber(RobotId id, int number) {
  const link::ScenarioRobot* known = robot(id);
  if (known == nullptr) return;
  sim::RobotIdentity after = known->identity;
  after.number = number;
  if (wearsAnother(after)) return;
  change(identityField, {{id, after}}, QStringLiteral("Renumber %1 as ") + robotName(after));
}

void MatchEdits::setBehaviour(const std::vector<RobotId>& ids, const QString& behaviour) {
  Values<std::string> after;
  for (const RobotId id : ids) after.emplace_back(id, behaviour.toStdString());
  change(behaviourField, std::move(after),
         QStringLiteral("Change the behaviour of %1 to ") + behaviour);
}

void MatchEdits::setModel(const std::vector<RobotId>& ids, const sim::RobotModel& model) {
  Values<sim::RobotModel> after;
  for (const RobotId id : ids) after.emplace_back(id, model);
  change(modelField, std::move(after), QStringLiteral("Change the model of %1"),
         QStringLiteral("model"));
}

void MatchEdits::setRuntime(RobotId id, const link::RuntimeChoice& choice) {
  change(runtimeField, {{id, choice}}, QStringLiteral("Change the runtime of %1"));
}

void MatchEdits::adviseTeam(TeamColor team, const std::optional<link::AdvisorOptions>& advisor) {
  const auto before = m_advisors;
  if (advisor) {
    m_advisors[team] = *advisor;
  } else {
    m_advisors.erase(team);
  }
  post({QStringLiteral("Could not change the advisor of the team"),
        [team, advisor](link::SimulatedMatch& match) {
          return match.robots().setAdvisor(team, advisor);
        },
        [this, before] {
          m_advisors = before;
          emit robotsChanged();
        },
        {},
        link::Changed::No});
  emit robotsChanged();
}

void MatchEdits::setAdvised(TeamColor team, bool on) {
  if (on == isAdvised(team)) return;
  std::optional<link::AdvisorOptions> before, after;
  if (on) {
    after.emplace();
  } else {
    before = m_advisors.at(team);  // with its numbers
  }
  const std::string_view name = info(team).name;
  const QString who = QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
  const QString text = on ? QStringLiteral("Turn on the %1 team's advisor")
                          : QStringLiteral("Turn off the %1 team's advisor");
  perform({text.arg(who), [this, team, after] { adviseTeam(team, after); },
           [this, team, before] { adviseTeam(team, before); }});
}

void MatchEdits::takePhysics(const std::string& name) {
  if (std::exchange(m_physics, name) != name) emit physicsChanged();
}

void MatchEdits::switchPhysics(const std::string& name,
                               const std::function<void(sim::Simulation&)>& report) {
  const std::string before = m_physics;
  takePhysics(name);
  post({QStringLiteral("Could not change the physics model"),
        [name, report](link::SimulatedMatch& match) -> Result<void> {
          TRY(match.simulation().setPhysics(name));
          report(match.simulation());
          return {};
        },
        [this, before] { takePhysics(before); }});
}

void MatchEdits::setPhysics(const QString& model) {
  const std::string after = model.toStdString();
  if (after == m_physics) return;
  const auto changed = [cause = newCause()](sim::Simulation& simulation) {
    simulation.reportChanged(sim::Setting::Physics, cause);
  };
  const auto undone = [cause = m_lastCause](sim::Simulation& simulation) {
    simulation.reportUndone(cause);
  };
  perform({QStringLiteral("Play with %1 physics").arg(model),
           [this, after, changed] { switchPhysics(after, changed); },
           [this, before = m_physics, undone] { switchPhysics(before, undone); }});
}

void MatchEdits::replaceMatch(const link::Scenario& scenario, const QString& text,
                              const QString& done, bool paused, std::function<void()> between) {
  if (!m_match->isOpen()) {
    m_match->replace(scenario, paused, std::move(between));
    return;
  }
  const auto other = std::make_shared<std::shared_ptr<RetiredMatch>>();  // that is not played
  m_replacing = true;
  *other = m_match->replace(scenario, paused, std::move(between));
  m_replacing = false;
  const auto swap = [this, other] {
    m_replacing = true;
    *other = m_match->bringBack(*other);
    m_replacing = false;
  };
  m_undoStack->push(new EditCommand({text, swap, swap, {}, true}));
  emit replaced(done);
}

void MatchEdits::commandAction(RobotId id, int actionA, std::optional<int> actionB) {
  order([id, actionA, actionB](link::SimulatedMatch& match) {
    link::Blackboard* board = match.blackboard(id);
    if (board == nullptr) return link::Changed::No;
    // B first: control reads it in the moment it sees a new A.
    if (actionB) board->write(match.variables().decisionActionB, *actionB);
    board->write(match.variables().decisionActionA, actionA);
    return link::Changed::No;
  });
}

void MatchEdits::commandSearch(RobotId id, bool on) {
  order([id, on](link::SimulatedMatch& match) {
    if (link::Blackboard* board = match.blackboard(id)) {
      board->write(match.variables().decisionSearchOn, on ? 1 : 0);
    }
    return link::Changed::No;
  });
}

void MatchEdits::writeVariable(RobotId id, const QString& name, double value) {
  const link::Variable* variable = m_match->catalog().find(name.toStdString());
  const QString notWritten = QStringLiteral("Could not write %1").arg(name);
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
             return failure(ErrorCode::NotFound, "the robot is no longer on the field");
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
         [this, id, name, time] { emit variableWritten(id, name, *time); },
         link::Changed::No});
}

namespace {

/// Sets one value of the match; undone, it has the value that it had.
template <class Value, class Read, class Write>
EditStep settingStep(Value wanted, Read read, Write write) {
  const auto before = std::make_shared<Value>(wanted);
  return {
      [wanted, before, read, write](link::SimulatedMatch& match) {
        *before = read(match.simulation().state());
        return write(match.simulation(), wanted);
      },
      [before, write](link::SimulatedMatch& match) { return write(match.simulation(), *before); }};
}

}  // namespace

void MatchEdits::changeSetting(sim::Setting setting, const QString& text, const QString& whatFailed,
                               EditStep step) {
  // While a control is moved, its changes become one command, and one event.
  constexpr qint64 oneGesture = 500;  // ms, less than what EditCommand merges
  if (m_gesture.cause == 0 || m_gesture.setting != setting ||
      m_gesture.age.elapsed() > oneGesture) {
    m_gesture = {setting, newCause(), std::make_shared<bool>(false), {}};
  }
  m_gesture.age.start();
  // `reported` belongs to the match's thread.
  const auto reported = m_gesture.reported;
  const std::uint32_t cause = m_gesture.cause;
  EditStep reporting{
      [redo = std::move(step.redo), setting, cause, reported](link::SimulatedMatch& match) {
        auto done = redo(match);
        if (done && !std::exchange(*reported, true)) {
          match.simulation().reportChanged(setting, cause);
        }
        return done;
      },
      [undo = std::move(step.undo), cause, reported](link::SimulatedMatch& match) {
        auto undone = undo(match);
        if (undone && std::exchange(*reported, false)) match.simulation().reportUndone(cause);
        return undone;
      }};
  performOrder(text, whatFailed, {std::move(reporting)}, m_gesture.mergeKey());
}

void MatchEdits::setNoise(const sim::NoiseParameters& noise) {
  changeSetting(sim::Setting::Noise, QStringLiteral("Change the noise"),
                QStringLiteral("Could not change the noise"),
                settingStep(
                    noise, [](const sim::WorldState& state) { return state.settings.noise; },
                    [](sim::Simulation& simulation, const sim::NoiseParameters& value) {
                      return simulation.setNoise(value);
                    }));
}

void MatchEdits::setRigidBody(const sim::RigidBodySettings& settings) {
  changeSetting(sim::Setting::Physics, QStringLiteral("Change the physics"),
                QStringLiteral("Could not change the physics"),
                settingStep(
                    settings, [](const sim::WorldState& state) { return state.settings.rigidBody; },
                    [](sim::Simulation& simulation, const sim::RigidBodySettings& value) {
                      return simulation.setRigidBody(value);
                    }));
}

void MatchEdits::setClockRunning(bool running) {
  performOrder(
      running ? QStringLiteral("Start the game clock") : QStringLiteral("Stop the game clock"),
      QStringLiteral("Could not change the clock"),
      {settingStep(
          running, [](const sim::WorldState& state) { return state.clockRunning; },
          [](sim::Simulation& simulation, bool value) -> Result<void> {
            simulation.setClockRunning(value);
            return {};
          })});
}

void MatchEdits::resetScore() {
  using ScoreAndClock = std::pair<sim::Score, std::uint64_t>;
  changeSetting(sim::Setting::ScoreAndClock, QStringLiteral("Reset score and clock"),
                QStringLiteral("Could not change the score"),
                settingStep(
                    ScoreAndClock{},
                    [](const sim::WorldState& state) {
                      return ScoreAndClock{state.score, state.clockTicks};
                    },
                    [](sim::Simulation& simulation, const ScoreAndClock& value) -> Result<void> {
                      simulation.setScore(value.first);
                      simulation.editState().clockTicks = value.second;
                      return {};
                    }));
}

void MatchEdits::orderProcesses(const std::function<void(link::ProcessManager&)>& what) {
  order([what](link::SimulatedMatch& match) {
    what(match.robots().processes());
    return link::Changed::No;
  });
}

void MatchEdits::startProcess(int process) {
  orderProcesses([process](link::ProcessManager& all) {
    all.start(process, std::chrono::steady_clock::now());
  });
}

void MatchEdits::stopProcess(int process) {
  orderProcesses([process](link::ProcessManager& all) { all.stop(process); });
}

void MatchEdits::restartProcess(int process) {
  orderProcesses([process](link::ProcessManager& all) {
    all.restart(process, std::chrono::steady_clock::now());
  });
}

void MatchEdits::killProcess(int process) {
  orderProcesses([process](link::ProcessManager& all) { all.kill(process); });
}

}  // namespace pitchboard::ui
