// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/robot_slots.h>

#include <algorithm>
#include <array>

#include <base/lined_json.h>
#include <base/try.h>
#include <robotlink/match/moment.h>
#include <robotlink/models/robot_models.h>

#include "match_base.h"

namespace pitchboard::link {
namespace {

using SteadyClock = std::chrono::steady_clock;
using OnlyFor = ProfileProcess::OnlyFor;

/// Whether the robot's processes were told something else: how it walks, kicks and how wide it is.
bool announcedDiffers(const sim::RobotModel& a, const sim::RobotModel& b) {
  const auto announced = [](const sim::RobotModel& m) {
    return std::array{m.forwardFast, m.forwardSlow,    m.backwardFast, m.backwardSlow, m.sideways,
                      m.turn,        m.aroundSideways, m.aroundTurn,   m.kickReach,    m.radius};
  };
  return announced(a) != announced(b) || a.kickLaw != b.kickLaw;
}

tl::unexpected<Error> noSuchRobot(RobotId id) {
  return failure(ErrorCode::NotFound,
                 "there is no robot " + std::to_string(id.value) + " on the field");
}

/// Refuses a name that is neither one of our behaviours nor "none of ours".
Result<void> checkBehaviour(const std::string& behaviour) {
  const auto known = behaviours();
  if (behaviour != noBehaviour && std::none_of(known.begin(), known.end(), [&](const auto& b) {
        return b.name == behaviour;
      })) {
    std::vector<std::string_view> names;
    for (const BehaviourInfo& b : known) names.push_back(b.name);
    names.push_back(noBehaviour);
    return failure(ErrorCode::NotFound, unknownName("behaviour", behaviour, names));
  }
  return {};
}

}  // namespace

RobotSlots::RobotSlots(MatchBase& base)
    : m_base(base), m_processes(std::make_unique<ProcessManager>(base.options.robotProgram)) {}

RobotSlots::~RobotSlots() {
  for (const auto& slot : m_slots) {
    for (const auto& process : slot->processes) {
      if (process->inside) process->inside->finish();
    }
  }
  m_processes.reset();
  m_slots.clear();  // robots first: the next owner of the match number claims them at once
}

RobotSlot* RobotSlots::find(RobotId id) const {
  const auto found = std::ranges::find(m_slots, id, [](const auto& slot) { return slot->id; });
  return found == m_slots.end() ? nullptr : found->get();
}

const sim::RobotIdentity& RobotSlots::identityOf(RobotId id) const {
  return m_base.simulation.state().robots[m_base.simulation.indexOf(id).value()];
}

const sim::RobotModel* RobotSlots::model(RobotId id) const {
  const auto index = m_base.simulation.indexOf(id);
  return index ? &m_base.simulation.state().models[*index] : nullptr;
}

double RobotSlots::responseTimeout(const RobotSlot& slot) {
  double most = slot.processes.empty() ? ProfileProcess().responseTimeout : 0.0;
  for (const auto& process : slot.processes)
    most = std::max(most, process->profile.responseTimeout);
  return most;
}

bool RobotSlots::haveTeamPrograms() const {
  return m_base.options.cognition != Cognition::Inline ||
         std::ranges::any_of(m_slots, [](const auto& slot) {
           return slot->board.key() != 0 && slot->runtime.hasOwn();
         });
}

std::vector<sim::RobotIdentity> RobotSlots::ofOthers() const {
  std::vector<sim::RobotIdentity> others;
  for (const auto& slot : m_slots) {
    if (slot->board.key() == 0 || !slot->runtime.processes.empty()) continue;
    // None else at its blackboard: an obstacle, or one that is steered by hand.
    const auto segment = SystemVSegments::info(slot->board.key());
    if (segment && segment->attached > 1) others.push_back(identityOf(slot->id));
  }
  return others;
}

Result<void> RobotSlots::changeAll(const std::function<Result<void>()>& f) {
  const sim::WorldState world = m_base.simulation.state();
  const auto slots = m_slots;
  const std::vector<RobotSetup> setups = [&] {
    std::vector<RobotSetup> all;
    for (const auto& slot : slots) all.push_back(*slot);
    return all;
  }();
  const auto has = [](const RobotSetup& setup, const auto& process) {
    return std::ranges::count(setup.processes, process) > 0;
  };
  Result<void> done = f();
  std::vector<int> stopped;
  if (done) {
    // Separate ones end first: two of a kind would fight over the blackboard.
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (!find(slots[i]->id)) continue;
      for (const auto& process : setups[i].processes) {
        const ProcessStatus* status = m_processes->status(process->id);
        if (has(*slots[i], process) || !status) continue;
        const ProcessState state = status->state;
        if (state < ProcessState::Ended) stopped.push_back(process->id);
        m_processes->stop(process->id);
      }
    }
  }
  std::vector<SlotProcess*> started;
  for (std::size_t i = 0; done && i < m_slots.size(); ++i) {
    done = startMissing(*m_slots[i], started);
  }
  if (!done) {
    for (SlotProcess* process : started) forget(*process);
    m_slots = slots;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      static_cast<RobotSetup&>(*slots[i]) = setups[i];
    }
    if (m_base.simulation.state() != world) (void)m_base.simulation.restore(world);
    for (const int id : stopped) m_processes->start(id, SteadyClock::now());
    return done;
  }
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const bool left = !find(slots[i]->id);
    for (const auto& process : setups[i].processes) {
      if (left || !has(*slots[i], process)) forget(*process);
    }
  }
  m_base.commands.resize(m_slots.size());
  m_base.percepts.resize(m_slots.size());
  return {};
}

Result<void> RobotSlots::change(RobotId id, const std::function<Result<void>(RobotSlot&)>& f) {
  return changeAll([&]() -> Result<void> {
    RobotSlot* slot = find(id);
    return slot ? f(*slot) : noSuchRobot(id);
  });
}

Result<void> RobotSlots::add(const ScenarioRobot& robot) {
  TRY(checkShirt(robot.identity));
  TRY(checkBehaviour(robot.behaviour));
  return changeAll([&]() -> Result<void> {
    TRY(m_base.simulation.addRobot(robot.identity, robot.pose, robot.model));
    auto slot = TRY(make(robot.identity.id, robot.behaviour, m_base.scenario.runtimeOf(robot)));
    slot->parameters = robot.parameters;
    m_base.writes.catchUp(slot->board);
    m_slots.push_back(std::move(slot));
    return {};
  });
}

Result<void> RobotSlots::remove(RobotId id) {
  return changeAll([&]() -> Result<void> {
    TRY(m_base.simulation.removeRobot(id));
    std::erase_if(m_slots, [id](const auto& slot) { return slot->id == id; });
    return {};
  });
}

Result<void> RobotSlots::become(const Moment& moment) {
  return changeAll([&]() -> Result<void> {
    std::vector<std::shared_ptr<RobotSlot>> slots;
    for (const sim::RobotIdentity& identity : moment.state.robots) {
      const MomentRobot* known = moment.robot(identity.id);
      const auto here =
          std::ranges::find(m_slots, identity.id, [](const auto& slot) { return slot->id; });
      if (here != m_slots.end()) {
        slots.push_back(*here);
        if (known && known->behaviour != slots.back()->behaviour) {
          TRY(setBehaviour(*slots.back(), known->behaviour));
        }
        continue;
      }
      slots.push_back(TRY(make(identity.id, known ? known->behaviour : std::string(noBehaviour),
                               m_base.scenario.runtimeOf(identity.team, {}))));
      for (const ScenarioRobot& one : m_base.scenario.robots) {
        if (one.identity.id == identity.id) slots.back()->parameters = one.parameters;
      }
    }
    TRY(m_base.simulation.restore(moment.state));
    m_slots = std::move(slots);
    return {};
  });
}

Result<void> RobotSlots::setBehaviour(RobotId id, const std::string& behaviour) {
  return change(id, [&](RobotSlot& slot) { return setBehaviour(slot, behaviour); });
}

Result<void> RobotSlots::setBehaviour(RobotSlot& slot, const std::string& behaviour) const {
  TRY(checkBehaviour(behaviour));
  slot.behaviour = behaviour;
  // No runtime was chosen, so the behaviour decides: without one, somebody else's programs play.
  slot.runtime = TRY(runtimeFor(behaviour, slot.choice));
  // Processes that depend on the behaviour restart, the others continue.
  std::erase_if(slot.processes,
                [](const auto& process) { return process->profile.onlyFor == OnlyFor::Behaviour; });
  return {};
}

Result<void> RobotSlots::setRuntime(RobotId id, const RuntimeChoice& choice) {
  return change(id, [&](RobotSlot& slot) -> Result<void> {
    slot.runtime =
        TRY(runtimeFor(slot.behaviour, m_base.scenario.runtimeOf(identityOf(id).team, choice)));
    if (slot.board.key() == 0 && slot.runtime.hasOwn() && choice.isChosen()) {
      return failure(
          ErrorCode::Unsupported,
          "this match runs inside one program, so other programs cannot reach its blackboards; "
          "start it with separate processes");
    }
    slot.choice = choice;
    slot.processes.clear();
    return {};
  });
}

Result<void> RobotSlots::setAdvisor(TeamColor team, const std::optional<AdvisorOptions>& advisor) {
  auto& advisors = m_base.scenario.advisors;
  const auto before = advisors;
  if (advisor) {
    advisors[team] = *advisor;
  } else {
    advisors.erase(team);
  }
  auto done = changeAll([&]() -> Result<void> {
    for (const auto& slot : m_slots) {
      if (identityOf(slot->id).team != team) continue;
      std::erase_if(slot->processes,
                    [](const auto& one) { return one->profile.onlyFor == OnlyFor::Advised; });
      if (!advisor) {
        const auto aside = VariableCatalog::extended().floatVar("ADVISOR_ASIDE");
        writeIfPresent(slot->board, aside.value_or(FloatVar{-1}), 0.0F);
      }
    }
    return {};
  });
  if (!done) advisors = before;
  return done;
}

Result<void> RobotSlots::setIdentity(const sim::RobotIdentity& identity) {
  return change(identity.id, [&](RobotSlot& slot) -> Result<void> {
    TRY(checkShirt(identity));
    const auto& game = m_base.simulation.state().game;
    if (game) TRY(sim::checkTeam(*game, identity.team));
    m_base.simulation.editState().robots[*m_base.simulation.indexOf(identity.id)] = identity;
    slot.processes.clear();
    return {};
  });
}

Result<void> RobotSlots::setModel(RobotId id, const sim::RobotModel& model) {
  return change(id, [&](RobotSlot& slot) -> Result<void> {
    const sim::RobotModel before = *this->model(id);
    if (before == model) return {};
    TRY(m_base.simulation.setRobotModel(id, model));
    if (announcedDiffers(before, model)) slot.processes.clear();
    return {};
  });
}

Result<void> RobotSlots::restartWithMatchTime() {
  return changeAll([&]() -> Result<void> {
    for (const auto& slot : m_slots) {
      std::erase_if(slot->processes, [](const auto& process) {
        return process->profile.clock == ProfileProcess::Clock::Real;
      });
      for (ProfileProcess& process : slot->runtime.processes)
        process.clock = ProfileProcess::Clock::Match;
    }
    return {};
  });
}

Result<void> RobotSlots::restartProcess(RobotId id, const std::string& process) {
  if (const RobotSlot* slot = find(id)) {
    for (const auto& one : slot->processes) {
      if (one->profile.name != process) continue;
      if (one->inside) return startInside(*slot, *one);
      m_processes->restart(one->id, SteadyClock::now());
      return {};
    }
  }
  return failure(ErrorCode::NotFound, "robot " + std::to_string(id.value) +
                                          " has no process called \"" + process + "\"");
}

Result<std::shared_ptr<RobotSlot>> RobotSlots::make(RobotId id, const std::string& behaviour,
                                                    const RuntimeChoice& choice) {
  auto slot = std::make_shared<RobotSlot>();
  slot->id = id;
  slot->behaviour = behaviour;
  slot->choice = choice;
  slot->runtime = TRY(runtimeFor(behaviour, choice));
  bool fresh = true;
  if (sharesBoard(*slot)) {
    TRY(identify());
    const MatchOptions& options = m_base.options;
    const int base = options.keyBase ? *options.keyBase : m_claim->number().keyBase();
    const int key = blackboardKey(id, base);
    slot->claim = TRY(BridgeClaim::take(key));
    // The guard is there before the segment, so that not even a kill between the two leaves it. A
    // match without processes continues without it; one with processes reports the reason.
    if (!options.robotProgram.empty()) (void)m_processes->keepGuard();
    slot->board = TRY(SystemVSegments::open(key, AttachMode::AttachOrCreate));
    m_processes->guardSegment(slot->board);
    fresh = slot->board.created();
  }
  // A segment that was there belongs to processes that may be running: it is left as it is.
  if (fresh && m_base.variables.decisionSearchOn.index >= 0) {
    slot->board.write(m_base.variables.decisionSearchOn, 1);
  }
  return slot;
}

Result<void> RobotSlots::checkShirt(const sim::RobotIdentity& identity) const {
  for (const sim::RobotIdentity& other : m_base.simulation.state().robots) {
    if (other.id != identity.id && other.team == identity.team && other.number == identity.number) {
      return failure(ErrorCode::Conflict,
                     "there is already a robot " + identity.name() + "; choose another number");
    }
  }
  return {};
}

Result<RuntimeProfile> RobotSlots::runtimeFor(const std::string& behaviour,
                                              RuntimeChoice choice) const {
  if (m_base.options.cognition == Cognition::None) {
    return loadRuntime({std::string(ownRuntime), {}, {}});
  }
  // Without a behaviour of ours the robot is an obstacle, or somebody else's.
  if (!choice.isChosen() && behaviour == noBehaviour) choice.profile = ownRuntime;
  return loadRuntime(choice.isChosen() ? choice : m_base.options.runtime);
}

}  // namespace pitchboard::link
