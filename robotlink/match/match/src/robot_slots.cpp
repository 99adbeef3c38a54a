// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/match/robot_slots.h>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <set>

#include <base/lined_json.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/match/moment.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/processes/robot_config.h>
#include <simcore/world/field_text.h>

#include "match_base.h"

namespace pitchboard::link {
namespace {

/// Of each robot of a team, so that none overwrites what another one has learned: "seen.json" is
/// "seen-2.json" for the robot with shirt 2.
std::string memoryOf(const std::string& path, const sim::RobotIdentity& robot) {
  if (path.empty()) return path;
  const std::filesystem::path whole(path);
  const std::string name =
      whole.stem().string() + '-' + std::to_string(robot.number) + whole.extension().string();
  return (whole.parent_path() / name).string();
}

/// Where the reference processes of a robot announce their cycles; empty: nowhere.
std::string announcedCycles(const RuntimeProfile& runtime) {
  const auto words = runtime.values.find(announceCyclesValue);
  return words == runtime.values.end() ? std::string() : words->second;
}

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

/// A folder of the published robots: the number that its file gives must lead to the blackboard of
/// the robot that it is to play.
Result<void> checkPublishedTree(const std::map<std::string, std::string>& values, int key) {
  const std::string file =
      values.at("folder") + "/AI" + values.at("n") + "/Control/Data/config.ini";
  const auto ini = TRY(readIniFile(file));
  const RobotId number = TRY(robotFromIni(ini));
  if (blackboardKey(number) == key) return {};
  return failure(ErrorCode::Conflict,
                 "says robot " + std::to_string(number.value) + ", whose blackboard is " +
                     std::to_string(blackboardKey(number)) + ", but this robot has " +
                     std::to_string(key) +
                     "; write its number into the file, and play the match as number 0",
                 file);
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

/// Whether other programs are to see its blackboard.
bool RobotSlots::sharesBoard(const RobotSlot& slot) const {
  const MatchOptions& options = m_base.options;
  return isSeparate(slot) || options.systemV || (slot.choice.isChosen() && slot.runtime.hasOwn()) ||
         (options.runtime.isChosen() && slot.runtime.hasOwn() && slot.behaviour != noBehaviour);
}

bool RobotSlots::isSeparate(const RobotSlot& slot) const {
  return m_base.options.cognition != Cognition::Inline || !slot.runtime.program.empty() ||
         !announcedCycles(slot.runtime).empty();
}

Result<void> RobotSlots::identify() {
  if (m_claim) return {};
  std::function<bool(MatchNumber)> suits;
  if (m_base.options.newBoards) {
    suits = [](MatchNumber number) { return SystemVSegments::list(number.keyBase()).empty(); };
  }
  m_claim = TRY(m_base.options.match ? MatchClaim::take(*m_base.options.match)
                                     : MatchClaim::takeFree(suits));
  m_base.options.process.setMatch(m_claim->number());
  return {};
}

bool RobotSlots::shouldRun(const RobotSlot& slot, const ProfileProcess& process) const {
  const BehaviourInfo* behaviour = findBehaviour(slot.behaviour);
  const bool decides = !slot.choice.decision.empty();
  switch (process.onlyFor) {
    case OnlyFor::Everyone:
      return true;
    case OnlyFor::Behaviour:
      return behaviour != nullptr;
    case OnlyFor::Pose:
      // A program in place of decision may use it, too.
      return behaviour ? behaviour->usesPose || decides : decides;
    case OnlyFor::Separate:
      return isSeparate(slot);
    case OnlyFor::Target:
      return behaviour && behaviour->usesPose && slot.runtime.usesExtension();
    case OnlyFor::Advised:
      return slot.behaviour == "keeper" && slot.runtime.usesExtension() &&
             advisorOf(slot) != nullptr;
  }
  return true;
}

/// Null: its team has no advisor.
const AdvisorOptions* RobotSlots::advisorOf(const RobotSlot& slot) const {
  const auto& advisors = m_base.scenario.advisors;
  const auto found = advisors.find(identityOf(slot.id).team);
  return found == advisors.end() ? nullptr : &found->second;
}

/// The index is below 0 if the match does not wait for cycles.
Result<IntVar> RobotSlots::cycleOf(const RobotSlot& slot) const {
  auto name = expanded(slot.runtime.cycle, valuesFor(slot));
  if (name && name->empty()) return IntVar{-1};
  const auto variable =
      name ? m_base.catalog->withExtension().intVar(*name) : std::optional<IntVar>();
  if (variable) return *variable;
  return failure(ErrorCode::NotFound,
                 name ? "waits for \"" + *name + "\", which is not an int variable of this catalog"
                      : name.error().message,
                 "the runtime profile " + slot.runtime.name + ", cycle");
}

/// Puts the processes in the order of the profile; adds to `started` what it has to start.
Result<void> RobotSlots::startMissing(RobotSlot& slot, std::vector<SlotProcess*>& started) {
  slot.extended = slot.runtime.usesExtension();
  slot.cycle = TRY(cycleOf(slot));
  auto running = std::exchange(slot.processes, {});
  for (const ProfileProcess& profile : slot.runtime.processes) {
    if (!shouldRun(slot, profile)) continue;
    const auto found = std::ranges::find_if(
        running, [&profile](const auto& one) { return one && one->profile == profile; });
    if (found != running.end()) {
      slot.processes.push_back(std::move(*found));
      continue;
    }
    const auto& process = slot.processes.emplace_back(std::make_shared<SlotProcess>());
    process->profile = profile;
    started.push_back(process.get());
    TRY(start(slot, *process));
  }
  slot.programs.clear();
  for (const auto& process : slot.processes) {
    const ProcessStatus* status = m_processes->status(process->id);
    if (status == nullptr || !status->isTeamProgram) continue;
    const std::string program = status->program();
    if (std::ranges::find(slot.programs, program) == slot.programs.end())
      slot.programs.push_back(program);
  }
  return {};
}

void RobotSlots::forget(SlotProcess& process) {
  if (process.id != 0) m_processes->removeOne(process.id);
  if (process.lockStepSlot >= 0) m_lockStepSlots->release(process.lockStepSlot);
}

Result<void> RobotSlots::start(RobotSlot& slot, SlotProcess& process) {
  const ProfileProcess& profile = process.profile;
  slot.facesLeft = identityOf(slot.id).imuStartsAt180;
  process.startTick = m_base.tick();
  if (profile.isReference() && findProcess(profile.reference) == nullptr) {
    std::vector<std::string_view> known;
    for (const ProcessInfo& info : referenceProcesses()) known.push_back(info.name);
    return failure(ErrorCode::NotFound, unknownName("reference process", profile.reference, known),
                   "the runtime profile " + slot.runtime.name);
  }
  if (profile.isReference() && !isSeparate(slot)) {
    return startInside(slot, process);
  }
  TRY(identify());
  TRY(m_processes->keepGuard());
  ManagedProcess managed;
  managed.spec.robot = slot.id;
  managed.spec.name = profile.name;
  managed.spec.stopSignal = profile.stopSignal;
  managed.restart = profile.restart;
  managed.delay = profile.delay;
  managed.responseTimeout = RestartRule::Seconds(profile.responseTimeout);
  TRY(profile.isReference() ? describeReference(slot, process, managed)
                            : describeTeamProgram(slot, profile, managed));
  if (!profile.isReference() && slot.cycle.index >= 0) {
    slot.board.write(slot.cycle, 0);  // what an earlier program left
    slot.cooperates = slot.hasMissedCycle = false;
    slot.awaitedSince.reset();
  }
  process.id = TRY(m_processes->add(managed, slot.board, SteadyClock::now()));
  return {};
}

Result<void> RobotSlots::startInside(const RobotSlot& slot, SlotProcess& process) {
  process.inside = TRY(findProcess(process.profile.reference)->make(inlineOptions(slot)));
  process.known = true;
  process.period = process.inside->period();
  process.nextTick = nextDueTick(process.period, m_base.tick(), m_base.tickRate());
  return {};
}

Result<void> RobotSlots::describeReference(const RobotSlot& slot, SlotProcess& process,
                                           ManagedProcess& managed) {
  if (!m_lockStepSlots) m_lockStepSlots = TRY(LockStepSlots::create());
  managed.spec.command = commandOf(slot, process.profile.reference);
  const std::string& program = slot.runtime.program;
  if (program.find('/') != std::string::npos && ::access(program.c_str(), X_OK) != 0) {
    return failure(ErrorCode::NotFound, "cannot run " + program + ": " + systemReason(errno),
                   "the runtime profile " + slot.runtime.name + ", program");
  }
  managed.spec.inherited = m_lockStepSlots->descriptor();
  managed.watch = ManagedProcess::Watch::Caller;
  // Each start gets a new slot, without data of the previous process.
  managed.prepare = [slots = m_lockStepSlots, mine = &process](ChildSpec& spec) -> Result<void> {
    if (mine->lockStepSlot >= 0) slots->release(mine->lockStepSlot);
    mine->lockStepSlot = -1;
    mine->given = false;
    mine->lockStepSlot = TRY(slots->take());
    spec.command.insert(spec.command.end(),
                        {"--lock-step-slot", std::to_string(mine->lockStepSlot)});
    return {};
  };
  return {};
}

Result<void> RobotSlots::describeTeamProgram(const RobotSlot& slot, const ProfileProcess& profile,
                                             ManagedProcess& managed) const {
  const auto values = valuesFor(slot);
  const auto replaced = [&values, &slot](std::string& text) -> Result<void> {
    auto done = expanded(text, values);
    if (!done) {
      done.error().context = "the runtime profile " + slot.runtime.name;
      return tl::unexpected(done.error());
    }
    text = std::move(*done);
    return {};
  };
  managed.spec.command = profile.command;
  managed.spec.directory = profile.directory;
  managed.spec.environment = profile.environment;
  for (std::string& word : managed.spec.command) {
    TRY(replaced(word));
  }
  TRY(replaced(managed.spec.directory));
  for (auto& [name, value] : managed.spec.environment) {
    TRY(replaced(value));
  }
  constexpr const char* drawTo = "PITCHBOARD_DRAW";
  auto& environment = managed.spec.environment;
  if (std::ranges::none_of(environment, [](const auto& set) { return set.first == drawTo; })) {
    environment.emplace_back(drawTo,
                             "127.0.0.1:" + std::to_string(m_claim->number().drawingPort()));
  }
  if (slot.runtime.name == "published-tree") {
    TRY(checkPublishedTree(values, slot.board.key()));
  }
  managed.spec.isTeamProgram = true;
  managed.watchFile = profile.watchFile;
  managed.ownTime = profile.clock == ProfileProcess::Clock::Match;
  if (!profile.heartbeat.empty()) {
    const auto variable = m_base.catalog->intVar(profile.heartbeat);
    if (!variable) {
      return failure(
          ErrorCode::NotFound,
          "listens for \"" + profile.heartbeat + "\", which is not an int variable of this catalog",
          "the runtime profile " + slot.runtime.name + ", process " + profile.name);
    }
    managed.heartbeat = *variable;
    managed.watch = ManagedProcess::Watch::Variable;
    const auto& all = slot.runtime.processes;
    managed.clears = std::none_of(all.begin(), all.end(), [](const ProfileProcess& one) {
      return one.name == "communication" || one.name == "sending";
    });
  }
  return {};
}

/// What ${...} stands for in commands.
std::map<std::string, std::string> RobotSlots::valuesFor(const RobotSlot& slot) const {
  std::map<std::string, std::string> values = slot.runtime.values;
  const int number = slot.id.value;
  values["robot"] = std::to_string(number);
  values["n"] = number == 1 ? std::string() : std::to_string(number);
  values["key"] = std::to_string(slot.board.key());
  const sim::RobotIdentity& identity = identityOf(slot.id);
  const ProcessOptions& options = m_base.options.process;
  values["team"] = info(identity.team).name;
  values["team_index"] = std::to_string(options.team + static_cast<int>(identity.team));
  values["shirt"] = std::to_string(identity.number);
  values["match"] = std::to_string(m_claim ? m_claim->number().value : 0);
  values["behaviour"] = behaviourToText(
      slot.behaviour == noBehaviour ? options.behaviour : slot.behaviour, slot.parameters);
  values["field"] = sim::fieldToText(sim::playedField(m_base.scenario.settings));
  values["model"] = robotModelToText(*model(slot.id));
  return values;
}

std::shared_ptr<InProcessTeamChannel> RobotSlots::teamChannel(RobotId id) {
  auto& channel = m_teamChannels[static_cast<std::size_t>(identityOf(id).team)];
  if (!channel) channel = std::make_shared<InProcessTeamChannel>();
  return channel;
}

ProcessOptions RobotSlots::inlineOptions(const RobotSlot& slot) {
  ProcessOptions options = m_base.options.process;
  options.robot = slot.id;
  options.behaviour = slot.behaviour;
  options.parameters = slot.parameters;
  options.field = sim::playedField(m_base.scenario.settings);
  options.model = *model(slot.id);
  options.seed = m_base.scenario.settings.seed;
  if (m_base.options.announceSides) options.facesLeft = identityOf(slot.id).imuStartsAt180;
  options.teamChannel = teamChannel(slot.id);
  if (const AdvisorOptions* advisor = advisorOf(slot)) {
    options.advisor.memory = memoryOf(advisor->memory, identityOf(slot.id));
  }
  return options;
}

std::vector<std::string> RobotSlots::commandOf(const RobotSlot& slot,
                                               const std::string& process) const {
  const ProcessOptions& options = m_base.options.process;
  const sim::RobotIdentity& identity = identityOf(slot.id);
  std::vector<std::string> command{
      slot.runtime.program.empty() ? m_base.options.robotProgram : slot.runtime.program,
      process,
      "--robot",
      std::to_string(slot.id.value),
      "--match",
      std::to_string(m_claim->number().value),
      "--key",
      std::to_string(slot.board.key()),
      "--behaviour",
      behaviourToText(slot.behaviour == noBehaviour ? options.behaviour : slot.behaviour,
                      slot.parameters),
      "--udp-address",
      options.udpAddress,
      "--team",
      std::to_string(options.team + static_cast<int>(identity.team)),
      "--particles",
      std::to_string(options.particles),
      "--seed",
      std::to_string(m_base.scenario.settings.seed),
      "--field",
      sim::fieldToText(sim::playedField(m_base.scenario.settings)),
      "--robot-model",
      robotModelToText(*model(slot.id))};
  if (m_base.options.announceSides) {
    command.insert(command.end(), {"--attack", identity.imuStartsAt180 ? "left" : "right"});
  }
  if (const AdvisorOptions* advisor = advisorOf(slot)) {
    if (!advisor->memory.empty()) {
      command.insert(command.end(), {"--advisor-memory", memoryOf(advisor->memory, identity)});
      if (!options.keepsMemory) command.emplace_back("--advisor-memory-read-only");
    }
  }
  if (options.publishedLocalization) command.emplace_back("--published-localization");
  if (const std::string words = announcedCycles(slot.runtime); !words.empty()) {
    command.insert(command.end(), {"--announce-cycles", words});
  }
  if (m_base.cognitionDebug) {
    command.insert(command.end(), {"--debug-port", std::to_string(m_base.cognitionDebug->port())});
  }
  return command;
}

}  // namespace pitchboard::link
