// SPDX-License-Identifier: GPL-3.0-or-later
// Who runs for each robot: starting, ending and restarting the processes of its runtime profile.
#include <algorithm>
#include <filesystem>

#include <base/lined_json.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/processes/robot_config.h>
#include <simcore/world/field_text.h>

#include "match_seat.h"

namespace pitchboard::link {
namespace {

using SteadyClock = std::chrono::steady_clock;
using OnlyFor = ProfileProcess::OnlyFor;

/// A folder of the published robots: the number that its file gives must lead to the blackboard of
/// the robot that it is to play.
Result<void> checkPublishedTree(const std::map<std::string, std::string>& values, int key) {
  const std::string file =
      values.at("folder") + "/AI" + values.at("n") + "/Control/Data/config.ini";
  const auto ini = readIniFile(file);
  if (!ini) return tl::unexpected(ini.error());
  const auto number = robotFromIni(*ini);
  if (!number) return tl::unexpected(number.error());
  if (blackboardKey(*number) == key) return {};
  return failure(ErrorCode::Conflict,
                 "says robot " + std::to_string(number->value) + ", whose blackboard is " +
                     std::to_string(blackboardKey(*number)) + ", but this robot has " +
                     std::to_string(key) +
                     "; write its number into the file, and play the match as number 0",
                 file);
}

}  // namespace

Result<RuntimeProfile> SimulatedMatch::runtimeFor(const Wish& wish) const {
  if (m_options.cognition == Cognition::None) {
    return loadRuntime({std::string(ownRuntime), {}, {}});
  }
  RuntimeChoice choice = wish.choice;
  // Without a behaviour of ours the robot is an obstacle, or somebody else's.
  if (!choice.isChosen() && wish.behaviour == noBehaviour) choice.profile = ownRuntime;
  if (!choice.isChosen()) choice = m_options.runtime;
  return loadRuntime(choice);
}

/// Whether other programs are to see its blackboard.
bool SimulatedMatch::sharesBoard(const Seat& seat, const RuntimeProfile& runtime) const {
  return m_options.cognition != Cognition::Inline || m_options.systemV ||
         (seat.choice.isChosen() && runtime.hasOwn()) ||
         (m_options.runtime.isChosen() && runtime.hasOwn() && seat.behaviour != noBehaviour);
}

Result<void> SimulatedMatch::identify() {
  if (m_claim) return {};
  auto claim = m_options.match ? MatchClaim::take(*m_options.match) : MatchClaim::takeFree();
  if (!claim) return tl::unexpected(claim.error());
  m_claim = std::make_shared<MatchClaim>(std::move(*claim));
  m_options.process.setMatch(m_claim->number());
  return {};
}

std::optional<MatchNumber> SimulatedMatch::number() const {
  return m_claim ? std::optional(m_claim->number()) : std::nullopt;
}

std::string SimulatedMatch::publishedHolder() const {
  return m_claim ? m_claim->publishedHolder() : std::string();
}

int SimulatedMatch::keyOf(RobotId id) const {
  const int base = m_options.keyBase ? *m_options.keyBase : m_claim ? number()->keyBase() : 0;
  return blackboardKey(id, base);
}

const sim::RobotIdentity& SimulatedMatch::identityOf(RobotId id) const {
  return m_simulation.state().robots[m_simulation.indexOf(id).value()];
}

std::vector<sim::RobotIdentity> SimulatedMatch::robotsOfOthers() const {
  std::vector<sim::RobotIdentity> others;
  for (const auto& seat : m_seats) {
    if (seat->board.key() == 0 || !seat->runtime.processes.empty()) continue;
    // Nobody else at its blackboard: an obstacle, or one that is steered by hand.
    const auto segment = SystemVSegments::info(seat->board.key());
    if (segment && segment->attached > 1) others.push_back(identityOf(seat->id));
  }
  return others;
}

bool SimulatedMatch::wants(const Seat& seat, const ProfileProcess& process) const {
  const BehaviourInfo* behaviour = findBehaviour(seat.behaviour);
  const bool decides = !seat.choice.decision.empty();
  switch (process.onlyFor) {
    case OnlyFor::Everyone:
      return true;
    case OnlyFor::Behaviour:
      return behaviour != nullptr;
    case OnlyFor::Pose:
      // A program in place of decision may use it, too.
      return behaviour ? behaviour->usesPose || decides : decides;
    case OnlyFor::Separate:
      return m_options.cognition != Cognition::Inline;
    case OnlyFor::Target:
      return behaviour && behaviour->usesPose && seat.runtime.usesExtension();
  }
  return true;
}

Result<void> SimulatedMatch::startProcesses(Seat& seat) {
  seat.facesLeft = identityOf(seat.id).imuStartsAt180;
  seat.extended = seat.runtime.usesExtension();
  std::vector<std::unique_ptr<SeatProcess>> all;
  for (const ProfileProcess& profile : seat.runtime.processes) {
    if (!wants(seat, profile)) continue;
    const auto running =
        std::find_if(seat.processes.begin(), seat.processes.end(),
                     [&profile](const auto& one) { return one && one->profile == profile; });
    if (running != seat.processes.end()) {
      all.push_back(std::move(*running));
      continue;
    }
    auto started = startProcess(seat, profile);
    if (!started) {
      for (auto& one : all) seat.processes.push_back(std::move(one));
      std::erase(seat.processes, nullptr);
      return tl::unexpected(started.error());
    }
    all.push_back(std::move(*started));
  }
  std::erase(seat.processes, nullptr);
  endProcesses(seat);
  seat.processes = std::move(all);
  return {};
}

void SimulatedMatch::endProcesses(Seat& seat) {
  for (const auto& process : seat.processes) {
    if (process->id != 0) m_processes->removeOne(process->id);
    if (process->place >= 0) m_turns->giveBack(process->place);
  }
  seat.processes.clear();
}

Result<std::unique_ptr<SeatProcess>> SimulatedMatch::startProcess(Seat& seat,
                                                                  const ProfileProcess& profile) {
  auto process = std::make_unique<SeatProcess>();
  process->profile = profile;
  process->startTick = m_simulation.state().tick;
  if (profile.isReference() && findProcess(profile.reference) == nullptr) {
    std::vector<std::string_view> known;
    for (const ProcessInfo& info : cognitiveProcesses()) known.push_back(info.name);
    return failure(ErrorCode::NotFound, unknownName("reference process", profile.reference, known),
                   "the runtime profile " + seat.runtime.name);
  }
  const bool inside = profile.isReference() && m_options.cognition == Cognition::Inline;
  Result<void> started = inside                  ? startInside(seat, *process)
                         : profile.isReference() ? startReference(seat, *process)
                                                 : startForeign(seat, *process);
  if (!started) return tl::unexpected(started.error());
  return process;
}

Result<void> SimulatedMatch::startInside(Seat& seat, SeatProcess& process) {
  auto made = findProcess(process.profile.reference)->make(inlineOptions(seat));
  if (!made) return tl::unexpected(made.error());
  process.inside = std::move(*made);
  process.known = true;
  process.period = process.inside->period();
  process.nextTick = nextDueTick(process.period, m_simulation.state().tick);
  return {};
}

Result<void> SimulatedMatch::startReference(Seat& seat, SeatProcess& process) {
  if (auto identified = identify(); !identified) return identified;
  if (auto guarded = m_processes->keepGuard(); !guarded) return guarded;
  if (!m_turns) {
    auto made = MatchTurns::create();
    if (!made) return tl::unexpected(made.error());
    m_turns = std::move(*made);
  }
  ManagedProcess managed;
  managed.spec = {seat.id, process.profile.name, commandOf(seat, process.profile.reference)};
  managed.spec.stopSignal = process.profile.stopSignal;
  managed.spec.inherited = m_turns->descriptor();
  managed.restart = process.profile.restart;
  managed.delay = process.profile.delay;
  managed.watch = ManagedProcess::Watch::Caller;
  managed.silentAfter = RestartRule::Seconds(process.profile.silentAfter);
  // Each start has a place of its own: nothing of the process before it stands there.
  managed.prepare = [turns = m_turns, mine = &process](ChildSpec& spec) -> Result<void> {
    if (mine->place >= 0) turns->giveBack(mine->place);
    mine->place = -1;
    mine->given = false;
    const auto place = turns->takePlace();
    if (!place) return tl::unexpected(place.error());
    mine->place = *place;
    spec.command.insert(spec.command.end(), {"--match-turns", std::to_string(*place)});
    return {};
  };
  const auto id = m_processes->add(managed, seat.board, SteadyClock::now());
  if (!id) return tl::unexpected(id.error());
  process.id = *id;
  return {};
}

Result<void> SimulatedMatch::startForeign(Seat& seat, SeatProcess& process) {
  if (auto identified = identify(); !identified) return identified;
  if (auto guarded = m_processes->keepGuard(); !guarded) return guarded;
  const ProfileProcess& profile = process.profile;
  const auto values = valuesFor(seat);
  const auto replaced = [&values, &seat](std::string& text) -> Result<void> {
    auto done = expanded(text, values);
    if (!done) {
      done.error().context = "the runtime profile " + seat.runtime.name;
      return tl::unexpected(done.error());
    }
    text = std::move(*done);
    return {};
  };
  ManagedProcess managed;
  managed.spec = {seat.id, profile.name, profile.command, profile.directory, profile.environment};
  for (std::string& word : managed.spec.command) {
    if (auto done = replaced(word); !done) return done;
  }
  if (auto done = replaced(managed.spec.directory); !done) return done;
  for (auto& [name, value] : managed.spec.environment) {
    if (auto done = replaced(value); !done) return done;
  }
  constexpr const char* drawTo = "PITCHBOARD_DRAW";
  auto& environment = managed.spec.environment;
  if (std::ranges::none_of(environment, [](const auto& set) { return set.first == drawTo; })) {
    environment.emplace_back(drawTo, "127.0.0.1:" + std::to_string(number()->drawingPort()));
  }
  if (seat.runtime.name == "published-tree") {
    if (auto good = checkPublishedTree(values, seat.board.key()); !good) return good;
  }
  managed.spec.stopSignal = profile.stopSignal;
  managed.spec.foreign = true;
  managed.restart = profile.restart;
  managed.delay = profile.delay;
  managed.silentAfter = RestartRule::Seconds(profile.silentAfter);
  managed.watchFile = profile.watchFile;
  managed.ownTime = profile.clock == ProfileProcess::Clock::Match;
  if (!profile.heartbeat.empty()) {
    const auto variable = m_catalog->intVar(profile.heartbeat);
    if (!variable) {
      return failure(ErrorCode::NotFound,
                     "listens for \"" + profile.heartbeat +
                         "\", which is no whole-number variable of this variable catalog",
                     "the runtime profile " + seat.runtime.name + ", process " + profile.name);
    }
    managed.heartbeat = *variable;
    managed.watch = ManagedProcess::Watch::Variable;
    const auto& all = seat.runtime.processes;
    managed.clears = std::none_of(all.begin(), all.end(), [](const ProfileProcess& one) {
      return one.name == "communication" || one.name == "sending";
    });
  }
  const auto id = m_processes->add(managed, seat.board, SteadyClock::now());
  if (!id) return tl::unexpected(id.error());
  process.id = *id;
  return {};
}

/// What ${...} stands for in commands.
std::map<std::string, std::string> SimulatedMatch::valuesFor(const Seat& seat) const {
  std::map<std::string, std::string> values = seat.runtime.values;
  const int number = seat.id.value;
  values["robot"] = std::to_string(number);
  values["n"] = number == 1 ? std::string() : std::to_string(number);
  values["key"] = std::to_string(seat.board.key());
  values["team"] = info(identityOf(seat.id).team).name;
  return values;
}

std::shared_ptr<TeamChannel> SimulatedMatch::teamChannel(RobotId id) {
  auto& channel = m_teamChannels[static_cast<std::size_t>(identityOf(id).team)];
  if (!channel) channel = std::make_shared<InProcessTeamChannel>();
  return channel;
}

ProcessOptions SimulatedMatch::inlineOptions(const Seat& seat) {
  ProcessOptions options = m_options.process;
  options.robot = seat.id;
  options.behaviour = seat.behaviour;
  options.parameters = seat.parameters;
  options.field = sim::playedField(m_scenario.settings);
  options.model = *robotModel(seat.id);
  options.seed = m_scenario.settings.seed;
  if (m_options.tellSides) options.facesLeft = identityOf(seat.id).imuStartsAt180;
  options.teamChannel = teamChannel(seat.id);
  return options;
}

std::vector<std::string> SimulatedMatch::commandOf(const Seat& seat,
                                                   const std::string& process) const {
  const ProcessOptions& options = m_options.process;
  const sim::RobotIdentity& identity = identityOf(seat.id);
  std::vector<std::string> command{
      m_options.robotProgram,
      process,
      "--robot",
      std::to_string(seat.id.value),
      "--match",
      std::to_string(m_claim->number().value),
      "--key",
      std::to_string(seat.board.key()),
      "--behaviour",
      behaviourToText(seat.behaviour == noBehaviour ? options.behaviour : seat.behaviour,
                      seat.parameters),
      "--udp-address",
      options.udpAddress,
      "--team",
      std::to_string(options.team + static_cast<int>(identity.team)),
      "--particles",
      std::to_string(options.particles),
      "--seed",
      std::to_string(m_scenario.settings.seed),
      "--field",
      sim::fieldToText(sim::playedField(m_scenario.settings)),
      "--robot-model",
      robotModelToText(*robotModel(seat.id))};
  if (m_options.tellSides) {
    command.insert(command.end(), {"--attack", identity.imuStartsAt180 ? "left" : "right"});
  }
  if (options.publishedLocalization) command.emplace_back("--published-localization");
  if (m_thoughts) {
    command.insert(command.end(), {"--thoughts-port", std::to_string(m_thoughts->port())});
  }
  return command;
}

Result<void> SimulatedMatch::restartProcesses(Seat& seat) {
  std::vector<std::unique_ptr<SeatProcess>> running = std::exchange(seat.processes, {});
  // Separate ones end first: two of a kind would fight over the blackboard.
  for (const auto& process : running) {
    if (process->id != 0) m_processes->stop(process->id);
  }
  auto started = startProcesses(seat);
  if (!started) {
    seat.processes = std::move(running);
    return started;
  }
  std::swap(seat.processes, running);
  endProcesses(seat);
  seat.processes = std::move(running);
  return {};
}

}  // namespace pitchboard::link
