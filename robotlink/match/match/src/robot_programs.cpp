// SPDX-License-Identifier: GPL-3.0-or-later
// Which programs a robot of a match has, and how they are started: inside the match, or as separate
// processes with their command lines.
#include <robotlink/match/robot_slots.h>

#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <filesystem>

#include <base/lined_json.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <robotlink/blackboard/cycle_words.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/processes/robot_config.h>
#include <simcore/world/field_text.h>

#include "match_base.h"

namespace pitchboard::link {
namespace {

using SteadyClock = std::chrono::steady_clock;
using OnlyFor = ProfileProcess::OnlyFor;

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
