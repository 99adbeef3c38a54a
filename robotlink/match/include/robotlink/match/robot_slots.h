// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots of a simulated match: of each its segment, the claim on it, who runs for it and its
// processes. They come, go and are changed here and not at the simulation. Every change is made
// whole or not at all. Not thread-safe: on the match's thread.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/blackboard/blackboard.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/match/match_options.h>
#include <robotlink/processes/match_turns.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

struct MatchBase;
struct Moment;

/// A process of a robot: inside this program, or separate.
struct SlotProcess {
  ProfileProcess profile;
  std::unique_ptr<CognitiveProcess> inside;  ///< nothing: it is separate
  int id = 0;                                ///< of a separate one, in the manager
  bool known = false;                        ///< how often it wants a turn is known
  double period = 0.0;                       ///< s, once known
  std::uint64_t startTick = 0;               ///< after which it was started
  std::uint64_t nextTick = 0;                ///< runs after the tick that ends here

  // Of a team's program: see ProcessPace::awaitsPrograms().
  bool settled = false;  ///< it is not waited for any more
  std::optional<std::chrono::steady_clock::time_point> awaitedSince{};

  // Of a separate one that takes turns (a reference process).
  int place = -1;      ///< its place in the turns; below 0: it has not been started
  bool given = false;  ///< it has been given the turn of this tick
  std::chrono::steady_clock::time_point givenAt{};

  bool takesTurns() const { return !inside && profile.isReference(); }
};

/// What RobotSlots::change() puts back after an error.
struct RobotSetup {
  std::string behaviour;
  BehaviourParameters parameters;  ///< of its behaviour
  RuntimeChoice choice;            ///< as told for this robot; may be nothing
  RuntimeProfile runtime;          ///< what that means
  bool extended = false;           ///< its decision knows the extension of the map
  IntVar cycle{-1};                ///< in which its program says that it has finished its cycle
  bool facesLeft = false;          ///< what its processes were told
  std::vector<std::shared_ptr<SlotProcess>> processes;
};

struct RobotSlot : RobotSetup {
  RobotId id;
  std::optional<BridgeClaim> claim;  ///< given back after the segment is gone
  Blackboard board = Blackboard::onHeap();
  RefereeOrders orders;
  std::size_t turn = 0;  ///< of `processes`, within a tick
  // Of a robot with `cycle`: see CycleWait.
  bool cooperates = false;      ///< its program has told that it is there
  bool hasMissedCycle = false;  ///< since it was started
  std::optional<std::chrono::steady_clock::time_point> awaitedSince{};  ///< at the beginning
};

class RobotSlots {
 public:
  /// `base` outlives it.
  explicit RobotSlots(MatchBase& base);
  RobotSlots(const RobotSlots&) = delete;
  RobotSlots& operator=(const RobotSlots&) = delete;
  ~RobotSlots();  ///< ends the processes, removes the segments that it created

  /// In the order of the simulation's robots.
  const std::vector<std::shared_ptr<RobotSlot>>& all() const { return m_slots; }
  /// Null when there is no such robot.
  RobotSlot* find(RobotId id) const;
  const sim::RobotIdentity& identityOf(RobotId id) const;
  /// Which kind of robot it is; null when there is no such robot.
  const sim::RobotModel* model(RobotId id) const;
  /// How long its programs may be silent, s.
  static double silentAfter(const RobotSlot& slot);
  /// Other programs see a robot's blackboard and may decide for it.
  bool haveTeamPrograms() const;
  /// Robots whose processes nobody here has started, so that they do not stop with the match.
  std::vector<sim::RobotIdentity> ofOthers() const;

  /// A robot with its blackboard and processes; scripted writes for every robot that are past are
  /// made up for.
  Result<void> add(const ScenarioRobot& robot);
  /// Ends its processes and removes its segment if this match created it.
  Result<void> remove(RobotId id);
  /// Its decision starts anew with this behaviour (a name of behaviours(), or noBehaviour); the
  /// other processes go on, and those that only this behaviour needs come or go.
  Result<void> setBehaviour(RobotId id, const std::string& behaviour);
  /// Who runs from now on; all processes of the robot start anew.
  Result<void> setRuntime(RobotId id, const RuntimeChoice& choice);
  /// Another team and shirt for the robot of this id; its processes start again. Conflict when the
  /// shirt is worn already.
  Result<void> setIdentity(const sim::RobotIdentity& identity);
  /// Another kind of robot from now on; its processes start again when they have to know.
  Result<void> setModel(RobotId id, const sim::RobotModel& model);
  /// Programs whose profile says "clock": "real" start again with the match's time; until another
  /// runtime is chosen for the robot.
  Result<void> restartWithMatchTime();
  /// Starts a process of the robot anew, separate or not; NotFound when it has none of that name.
  Result<void> restartProcess(RobotId id, const std::string& process);

  /// `f` changes the robot's setup, and what the simulation knows of it. Afterwards the processes
  /// that it took out of the setup end, and those that the setup wants and does not have start. An
  /// error, of `f` or of a start, leaves robot and world as they were; what had ended for it runs
  /// again.
  Result<void> change(RobotId id, const std::function<Result<void>(RobotSlot&)>& f);
  /// The world of this moment, with its robots and their behaviours; those that stay keep their
  /// processes.
  Result<void> become(const Moment& moment);

  /// Makes a process inside this program anew.
  Result<void> startInside(const RobotSlot& slot, SlotProcess& process);
  std::shared_ptr<InProcessTeamChannel> teamChannel(RobotId id);
  std::array<std::shared_ptr<InProcessTeamChannel>, teamColors.size()>& teamChannels() {
    return m_teamChannels;
  }
  ProcessManager& processes() { return *m_processes; }
  const ProcessManager& processes() const { return *m_processes; }
  /// Null while nobody takes turns.
  MatchTurns* turns() const { return m_turns.get(); }
  const std::optional<MatchClaim>& claim() const { return m_claim; }

 private:
  Result<void> changeAll(const std::function<Result<void>()>& f);
  Result<std::shared_ptr<RobotSlot>> make(RobotId id, const std::string& behaviour,
                                          const RuntimeChoice& choice);
  Result<RuntimeProfile> runtimeFor(const std::string& behaviour, RuntimeChoice choice) const;
  Result<void> setBehaviour(RobotSlot& slot, const std::string& behaviour) const;
  bool sharesBoard(const RobotSlot& slot) const;
  /// Its reference processes are programs of their own.
  bool isSeparate(const RobotSlot& slot) const;
  Result<void> identify();
  Result<void> checkShirt(const sim::RobotIdentity& identity) const;
  Result<IntVar> cycleOf(const RobotSlot& slot) const;
  const AdvisorOptions* advisorOf(const RobotSlot& slot) const;
  bool wants(const RobotSlot& slot, const ProfileProcess& process) const;
  Result<void> startMissing(RobotSlot& slot, std::vector<SlotProcess*>& started);
  Result<void> start(RobotSlot& slot, SlotProcess& process);
  Result<void> describeReference(const RobotSlot& slot, SlotProcess& process,
                                 ManagedProcess& managed);
  Result<void> describeForeign(const RobotSlot& slot, const ProfileProcess& profile,
                               ManagedProcess& managed) const;
  void forget(SlotProcess& process);
  ProcessOptions inlineOptions(const RobotSlot& slot);
  std::vector<std::string> commandOf(const RobotSlot& slot, const std::string& process) const;
  std::map<std::string, std::string> valuesFor(const RobotSlot& slot) const;

  MatchBase& m_base;
  std::vector<std::shared_ptr<RobotSlot>> m_slots;
  std::array<std::shared_ptr<InProcessTeamChannel>, teamColors.size()> m_teamChannels;
  std::optional<MatchClaim> m_claim;
  std::shared_ptr<MatchTurns> m_turns;
  std::unique_ptr<ProcessManager> m_processes;
};

}  // namespace pitchboard::link
