// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robots of a simulated match. A slot is one robot's shared memory segment, the claim on it,
// its runtime profile and its processes. Robots are added, removed and changed here, never directly
// in the simulation. Every change succeeds completely or leaves everything as it was. Not
// thread-safe: used on the match's thread.

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
#include <robotlink/processes/lock_step_slots.h>
#include <robotlink/processes/process_manager.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard::link {

struct MatchBase;
struct Moment;

/// A process of a robot: inside this program, or separate.
struct SlotProcess {
  ProfileProcess profile;
  std::unique_ptr<CognitiveProcess> inside;  ///< null: the process is separate
  int id = 0;                                ///< of a separate process, in the ProcessManager
  bool known = false;                        ///< `period` is known
  double period = 0.0;                       ///< s between two cycles
  std::uint64_t startTick = 0;               ///< tick after which the process was started
  std::uint64_t nextTick = 0;                ///< tick after which it runs next

  // Team programs only; see ProcessPace::awaitsPrograms().
  bool settled = false;  ///< the match no longer waits for it
  std::optional<std::chrono::steady_clock::time_point> awaitedSince{};

  // Separate reference processes only: they run in step with the match.
  int lockStepSlot = -1;  ///< index in LockStepSlots; below 0: not started yet
  bool given = false;     ///< its cycle in this tick has been started
  std::chrono::steady_clock::time_point givenAt{};

  bool isSeparateReference() const { return !inside && profile.isReference(); }
};

/// The part of a slot that RobotSlots::change() restores after an error.
struct RobotSetup {
  std::string behaviour;
  BehaviourParameters parameters;
  RuntimeChoice choice;    ///< what was chosen for this robot; may be empty
  RuntimeProfile runtime;  ///< the profile that follows from the choice
  bool extended = false;   ///< its decision process uses the extension of the variable map
  IntVar cycle{-1};        ///< variable in which its program reports the end of each cycle
  bool facesLeft = false;  ///< direction of attack that its processes were started with
  std::vector<std::shared_ptr<SlotProcess>> processes;
  std::vector<std::string> programs;  ///< files of its team programs, each once: "chase.py"
};

struct RobotSlot : RobotSetup {
  RobotId id;
  std::optional<BridgeClaim> claim;  ///< released after the segment has been removed
  Blackboard board = Blackboard::onHeap();
  RefereeOrders orders;
  std::size_t current = 0;  ///< index of the process that runs next in this tick
  // Robots with `cycle` only; see CycleWait.
  bool cooperates = false;      ///< its program has reported that it is ready
  bool hasMissedCycle = false;  ///< since the program was started
  std::optional<std::chrono::steady_clock::time_point> awaitedSince{};  ///< for the first report
};

class RobotSlots {
 public:
  /// `base` must outlive this object.
  explicit RobotSlots(MatchBase& base);
  RobotSlots(const RobotSlots&) = delete;
  RobotSlots& operator=(const RobotSlots&) = delete;
  ~RobotSlots();  ///< ends all processes and removes the segments that it created

  /// In the order of the simulation's robots.
  const std::vector<std::shared_ptr<RobotSlot>>& all() const { return m_slots; }
  /// Returns null if there is no such robot.
  RobotSlot* find(RobotId id) const;
  const sim::RobotIdentity& identityOf(RobotId id) const;
  /// Returns null if there is no such robot.
  const sim::RobotModel* model(RobotId id) const;
  /// Returns the time in s after which the robot's programs count as not responding.
  static double responseTimeout(const RobotSlot& slot);
  /// Returns whether programs outside this one can write to the blackboard of any robot.
  bool haveTeamPrograms() const;
  /// Returns the robots whose processes were started by somebody else and continue after the match.
  std::vector<sim::RobotIdentity> ofOthers() const;

  /// Adds a robot with its blackboard and processes. Blackboard values that the scenario scheduled
  /// for all robots at an earlier time are written now.
  Result<void> add(const ScenarioRobot& robot);
  /// Ends the robot's processes, and removes its segment if this match created it.
  Result<void> remove(RobotId id);
  /// Restarts the robot's decision process with this behaviour (a name from behaviours(), or
  /// noBehaviour). Other processes continue, except for those that only one of the two behaviours
  /// needs: they are started or ended.
  Result<void> setBehaviour(RobotId id, const std::string& behaviour);
  /// Changes the robot's runtime and restarts all of its processes.
  Result<void> setRuntime(RobotId id, const RuntimeChoice& choice);
  /// Gives the keeper of a team an advisor, or none (docs/advisor.md).
  Result<void> setAdvisor(TeamColor team, const std::optional<AdvisorOptions>& advisor);
  /// Changes team and shirt of the robot with this id and restarts its processes. Error Conflict if
  /// another robot has this shirt.
  Result<void> setIdentity(const sim::RobotIdentity& identity);
  /// Changes the robot's model, and restarts those processes that depend on it.
  Result<void> setModel(RobotId id, const sim::RobotModel& model);
  /// Restarts programs whose profile says "clock": "real" with the match's time. This holds until
  /// another runtime is chosen for the robot.
  Result<void> restartWithMatchTime();
  /// Restarts a process, separate or not. Error NotFound if the robot has none of that name.
  Result<void> restartProcess(RobotId id, const std::string& process);

  /// Calls `f` to change the robot's setup and its state in the simulation. Then it ends processes
  /// that `f` removed from the setup and starts those that the setup now requires. If `f` or a
  /// start fails, robot and world are restored, and ended processes are started again.
  Result<void> change(RobotId id, const std::function<Result<void>(RobotSlot&)>& f);
  /// Restores the world of this moment with its robots and behaviours. Robots that exist before and
  /// after keep their processes.
  Result<void> become(const Moment& moment);

  /// Creates a process inside this program, replacing any earlier one.
  Result<void> startInside(const RobotSlot& slot, SlotProcess& process);
  std::shared_ptr<InProcessTeamChannel> teamChannel(RobotId id);
  std::array<std::shared_ptr<InProcessTeamChannel>, teamColors.size()>& teamChannels() {
    return m_teamChannels;
  }
  ProcessManager& processes() { return *m_processes; }
  const ProcessManager& processes() const { return *m_processes; }
  /// Returns null while there are no separate reference processes.
  LockStepSlots* lockStepSlots() const { return m_lockStepSlots.get(); }
  const std::optional<MatchClaim>& claim() const { return m_claim; }

 private:
  Result<void> changeAll(const std::function<Result<void>()>& f);
  Result<std::shared_ptr<RobotSlot>> make(RobotId id, const std::string& behaviour,
                                          const RuntimeChoice& choice);
  Result<RuntimeProfile> runtimeFor(const std::string& behaviour, RuntimeChoice choice) const;
  Result<void> setBehaviour(RobotSlot& slot, const std::string& behaviour) const;
  bool sharesBoard(const RobotSlot& slot) const;
  /// Returns whether the robot's reference processes are separate.
  bool isSeparate(const RobotSlot& slot) const;
  Result<void> identify();
  Result<void> checkShirt(const sim::RobotIdentity& identity) const;
  Result<IntVar> cycleOf(const RobotSlot& slot) const;
  const AdvisorOptions* advisorOf(const RobotSlot& slot) const;
  bool shouldRun(const RobotSlot& slot, const ProfileProcess& process) const;
  Result<void> startMissing(RobotSlot& slot, std::vector<SlotProcess*>& started);
  Result<void> start(RobotSlot& slot, SlotProcess& process);
  Result<void> describeReference(const RobotSlot& slot, SlotProcess& process,
                                 ManagedProcess& managed);
  Result<void> describeTeamProgram(const RobotSlot& slot, const ProfileProcess& profile,
                                   ManagedProcess& managed) const;
  void forget(SlotProcess& process);
  ProcessOptions inlineOptions(const RobotSlot& slot);
  std::vector<std::string> commandOf(const RobotSlot& slot, const std::string& process) const;
  std::map<std::string, std::string> valuesFor(const RobotSlot& slot) const;

  MatchBase& m_base;
  std::vector<std::shared_ptr<RobotSlot>> m_slots;
  std::array<std::shared_ptr<InProcessTeamChannel>, teamColors.size()> m_teamChannels;
  std::optional<MatchClaim> m_claim;
  std::shared_ptr<LockStepSlots> m_lockStepSlots;
  std::unique_ptr<ProcessManager> m_processes;
};

}  // namespace pitchboard::link
