// SPDX-License-Identifier: GPL-3.0-or-later
// What is changed of robots and ball: who they are, where they are, what runs on them.
#include <ui/sources/match_edits.h>

#include <algorithm>
#include <utility>

#include <simcore/rules/referee.h>
#include <ui/base/robot_text.h>

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

template <class Items>
QString MatchEdits::subjectOf(const Items& items, RobotId first) const {
  if (items.size() != 1) return QStringLiteral("%1 robots").arg(items.size());
  const link::ScenarioRobot* known = robot(first);
  return known != nullptr ? robotName(known->identity) : QStringLiteral("robot");
}

template <class Value>
void MatchEdits::note(const Field<Value>& field, const Values<Value>& values) {
  for (const auto& [id, value] : values) {
    const auto known = m_robots.find(id);
    if (known != m_robots.end()) known->second.*field.member = value;
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
  const QString who = subjectOf(values, values.front().first);
  MatchEdit edit{text.arg(who), QString::fromUtf8(field.whatFailed).arg(who), {}};
  Values<Value> before;
  for (const auto& wanted : values) {
    const RobotId id = wanted.first;
    before.emplace_back(id, robot(id)->*field.member);
    const auto step = [carryOut = field.carryOut, id](const Value& value) {
      return
          [carryOut, id, value](link::SimulatedMatch& match) { return carryOut(match, id, value); };
    };
    edit.steps.push_back({step(wanted.second), step(before.back().second)});
  }
  if (!mergeKey.isEmpty()) {
    edit.mergeKey = mergeKeyOf(mergeKey, values, [](const auto& wanted) { return wanted.first; });
  }
  edit.note = [this, &field, values = std::move(values)] { note(field, values); };
  edit.takeBack = [this, &field, before = std::move(before)] { note(field, before); };
  edit.changes = field.changes;
  perform(std::move(edit));
}

EditStep placementStep(RobotId id, const Pose& pose) {
  const auto before = std::make_shared<Pose>(pose);
  return {[id, pose, before](link::SimulatedMatch& match) {
            *before = match.simulation().robotPose(id).value_or(pose);
            return match.simulation().placeRobot(id, pose);
          },
          [id, before](link::SimulatedMatch& match) {
            return match.simulation().placeRobot(id, *before);
          }};
}

EditStep ballStep(Point to, Velocity velocity) {
  const auto before = std::make_shared<std::pair<Point, Velocity>>();
  return {[to, velocity, before](link::SimulatedMatch& match) {
            const sim::Snapshot now = match.simulation().snapshot();
            *before = {now.ball, now.ballVelocity};
            return match.simulation().placeBall(to, velocity);
          },
          [before](link::SimulatedMatch& match) {
            return match.simulation().placeBall(before->first, before->second);
          }};
}

void MatchEdits::performPlacements(const std::vector<RobotPlacement>& placements,
                                   const QString& mergeKey) {
  if (placements.empty()) return;
  const QString who = subjectOf(placements, placements.front().id);
  MatchEdit edit{QStringLiteral("Move ") + who, QStringLiteral("Could not move ") + who, {}};
  edit.mergeKey = mergeKey;
  for (const RobotPlacement& one : placements) edit.steps.push_back(placementStep(one.id, one.to));
  perform(std::move(edit));
}

void MatchEdits::moveRobots(const std::vector<RobotPlacement>& placements) {
  performPlacements(placements, {});
}

void MatchEdits::nudgeRobots(const std::vector<RobotPlacement>& placements) {
  performPlacements(placements,
                    mergeKeyOf(QStringLiteral("nudge"), placements,
                               [](const RobotPlacement& placement) { return placement.id; }));
}

void MatchEdits::moveBall(Point to, Velocity velocity) {
  perform(
      {velocity == Velocity{} ? QStringLiteral("Move the ball") : QStringLiteral("Kick the ball"),
       QStringLiteral("Could not place the ball"),
       {ballStep(to, velocity)}});
}

void MatchEdits::noteRobots(const std::vector<link::ScenarioRobot>& robots, bool present) {
  for (const link::ScenarioRobot& entry : robots) {
    if (present)
      m_robots.insert_or_assign(entry.identity.id, entry);
    else
      m_robots.erase(entry.identity.id);
  }
}

namespace {

EditStep additionStep(const link::ScenarioRobot& entry) {
  return {
      [entry](link::SimulatedMatch& match) { return match.robots().add(entry); },
      [id = entry.identity.id](link::SimulatedMatch& match) { return match.robots().remove(id); }};
}

}  // namespace

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

QString MatchEdits::whyNoTeam(TeamColor team) const {
  const FramePtr frame = m_match->frame();
  if (!frame || !frame->rules || !frame->game) return {};
  const auto allowed = sim::checkTeam(*frame->game, team);
  return allowed ? QString() : QString::fromStdString(allowed.error().message);
}

bool MatchEdits::isTaken(const sim::RobotIdentity& wanted) const {
  return std::ranges::any_of(m_robots, [&wanted](const auto& known) {
    const sim::RobotIdentity& other = known.second.identity;
    return other.id != wanted.id && other.team == wanted.team && other.number == wanted.number;
  });
}

bool MatchEdits::refusesTaken(const sim::RobotIdentity& wanted) {
  if (!isTaken(wanted)) return false;
  emit failed(
      QStringLiteral("%1 is already on the field. Choose another number.").arg(robotName(wanted)));
  return true;
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
  auto mate = std::ranges::find_if(
      m_robots, [team](const auto& known) { return known.second.identity.team == team; });
  if (mate == m_robots.end()) mate = m_robots.begin();
  if (mate != m_robots.end()) entry.model = mate->second.model;
  if (refusesTaken(entry.identity)) return;
  const QString name = robotName(entry.identity);
  MatchEdit edit{QStringLiteral("Add ") + name,
                 QStringLiteral("Could not add ") + name,
                 {additionStep(entry)}};
  edit.note = [this, entry] {
    noteRobots({entry}, true);
    m_added.insert(entry.identity.id);
  };
  edit.takeBack = [this, entry] {
    noteRobots({entry}, false);
    m_added.erase(entry.identity.id);
  };
  perform(std::move(edit));
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
  const QString who = subjectOf(leaving, leaving.front().identity.id);
  MatchEdit edit{QStringLiteral("Remove ") + who, QStringLiteral("Could not remove ") + who, {}};
  for (const link::ScenarioRobot& gone : leaving) {
    EditStep back = additionStep(gone);
    edit.steps.push_back({std::move(back.undo), std::move(back.redo)});
  }
  edit.note = [this, leaving] { noteRobots(leaving, false); };
  edit.takeBack = [this, leaving] { noteRobots(leaving, true); };
  perform(std::move(edit));
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
  if (refusesTaken(after)) return;
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

void MatchEdits::noteAdvisor(TeamColor team, const std::optional<link::AdvisorOptions>& advisor) {
  if (advisor) {
    m_advisors[team] = *advisor;
  } else {
    m_advisors.erase(team);
  }
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
  const auto advise = [team](const std::optional<link::AdvisorOptions>& advisor) {
    return [team, advisor](link::SimulatedMatch& match) {
      return match.robots().setAdvisor(team, advisor);
    };
  };
  MatchEdit edit{text.arg(who),
                 QStringLiteral("Could not change the advisor of the team"),
                 {{advise(after), advise(before)}}};
  edit.note = [this, team, after] { noteAdvisor(team, after); };
  edit.takeBack = [this, team, before] { noteAdvisor(team, before); };
  edit.changes = link::Changed::No;
  perform(std::move(edit));
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
