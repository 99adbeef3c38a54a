// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <map>
#include <thread>

#include <base/try.h>
#include <robotlink/processes/team_program.h>
#include <simcore/world/field_text.h>

#include "feed.h"
#include "rerun_program.h"

namespace pitchboard::link {
namespace {

using namespace std::chrono_literals;
using ProgramTime = std::chrono::steady_clock;
using ProgramSeconds = std::chrono::duration<double>;

constexpr ProgramSeconds minPatienceToStart{10.0};  // on a busy computer
constexpr auto glance = 20ms;                       // between two looks at the program
constexpr auto spinFor = 50us, napFor = 50us;       // as a match waits for a cycle
constexpr double searchFactor = 2.0, fastestSearched = 1000.0;

class SeparateProgram final : public RerunProgram {
 public:
  SeparateProgram(RerunChoice choice, const ProgramPlace& place)
      : m_choice(std::move(choice)),
        m_board(*place.board),
        m_mayCooperate(place.mayCooperate),
        m_goesOn(place.goesOn),
        m_print(place.print),
        m_processes(place.robotProgram.empty() ? besideTeamProgram("pitchboard-robot")
                                               : place.robotProgram) {}

  Result<void> start(const RerunRobot& robot, const VariableCatalog& catalog);
  Result<void> awaitReady() override;
  Result<void> cycle(std::uint64_t tick) override;
  Result<void> run(std::uint64_t tick, double seconds) override;
  /// A team's program goes on, as on a real field.
  Result<void> changeSides(const RerunRobot&, std::uint64_t) override { return {}; }
  double allowedSpeed(double wanted) override;
  Result<void> lookAfter(double seconds, double speed) override;
  bool inLockStep() const override { return m_cooperates; }
  int turn() const override { return lastTurn; }
  const std::string& process() const override { return name(); }

 private:
  Result<void> look();
  tl::unexpected<Error> ended(const ProcessStatus& status) const;
  const std::string& name() const { return m_choice.process; }

  const RerunChoice m_choice;
  Blackboard& m_board;
  const bool m_mayCooperate;
  const std::function<bool()> m_goesOn;
  const std::function<void(std::string)> m_print;
  ProcessManager m_processes;
  int m_id = 0, m_shmid = -1;
  IntVar m_cycle{-1};
  bool m_cooperates = false;
  double m_speed = 1.0;  // that is searched
  ProgramTime::time_point m_searched{};
};

Result<void> SeparateProgram::start(const RerunRobot& robot, const VariableCatalog& catalog) {
  const std::string cycle = m_choice.cycle.empty() ? "MATCH_CYCLE" : m_choice.cycle;
  const auto variable = catalog.intVar(cycle);
  if (!variable && !m_choice.cycle.empty()) {
    return failure(ErrorCode::NotFound, "\"" + cycle + "\" is not an int variable of this catalog",
                   "cycle");
  }
  if (m_mayCooperate) m_cycle = variable.value_or(IntVar{-1});
  if (m_cycle.index >= 0) m_board.write(m_cycle, 0);
  const std::map<std::string, std::string> values{
      {"robot", std::to_string(robot.id.value)},
      {"n", robot.id.value == 1 ? std::string() : std::to_string(robot.id.value)},
      {"key", std::to_string(m_board.key())},
      {"team", std::string(info(robot.team).name)},
      {"team_index", std::to_string(static_cast<int>(robot.team))},
      {"shirt", std::to_string(robot.shirt)},
      {"behaviour", robot.behaviour},
      {"field", sim::fieldToText(robot.field)}};
  ManagedProcess managed;
  managed.spec.robot = robot.id;
  managed.spec.name = name();
  managed.spec.isTeamProgram = true;
  managed.restart.policy = RestartPolicy::Never;
  managed.ownTime = !m_choice.realClock;
  for (const std::string& word : m_choice.command) {
    managed.spec.command.push_back(TRY(expanded(word, values)));
  }
  managed.spec.directory = TRY(expanded(m_choice.directory, values));
  for (const auto& [key, value] : m_choice.environment) {
    managed.spec.environment.emplace_back(key, TRY(expanded(value, values)));
  }
  TRY(m_processes.keepGuard());
  m_processes.guardSegment(m_board);
  const auto info = SystemVSegments::info(m_board.key());
  m_shmid = info ? info->shmid : -1;
  m_id = TRY(m_processes.add(managed, m_board, ProgramTime::now()));
  return {};
}

Result<void> SeparateProgram::awaitReady() {
  const auto begin = ProgramTime::now();
  const auto patience = std::max(minPatienceToStart, ProgramSeconds(m_choice.responseTimeout));
  while (true) {
    TRY(look());
    // A program that cooperates says so before its first cycle; the others just attach.
    m_cooperates = m_cycle.index >= 0 && m_board.read(m_cycle) < 0;
    const bool expects = m_mayCooperate && !m_choice.cycle.empty();
    if (m_cooperates || (!expects && m_processes.hasSegment(m_id, m_shmid))) break;
    if (!m_goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
    if (ProgramTime::now() - begin > patience) {
      return failure(
          ErrorCode::SystemError,
          expects
              ? name() + " did not write -1 to " + m_choice.cycle + " within " + inSeconds(patience)
              : name() + " has not attached to the blackboard with key " +
                    std::to_string(m_board.key()) + " within " + inSeconds(patience) +
                    "; give it the key as an argument: ${key}");
    }
    std::this_thread::sleep_for(5ms);
  }
  // One that cooperates without being asked to is recognized if it says so at once.
  constexpr auto sayingSo = 300ms;
  const auto attached = ProgramTime::now();
  while (!m_cooperates && m_cycle.index >= 0 && ProgramTime::now() - attached < sayingSo) {
    TRY(look());
    m_cooperates = m_board.read(m_cycle) < 0;
    std::this_thread::sleep_for(5ms);
  }
  return {};
}

tl::unexpected<Error> SeparateProgram::ended(const ProcessStatus& status) const {
  std::string text = name() + " ended";
  if (!status.detail.empty()) text += ": " + status.detail;
  if (!status.lastLines.empty()) text += "; its last output: " + status.lastLines.back();
  return failure(ErrorCode::SystemError, text, name());
}

/// Collects what it prints, and notices its end and that of the blackboard.
Result<void> SeparateProgram::look() {
  TRY(m_processes.step(ProgramTime::now()));
  for (const ProcessLine& line : m_processes.drainLines()) m_print(name() + ": " + line.text);
  (void)m_processes.drainNews();
  const ProcessStatus* status = m_processes.status(m_id);
  if (!status || status->pid == 0) {
    return status ? Result<void>(ended(*status))
                  : failure(ErrorCode::SystemError, name() + " ended");
  }
  const auto segment = SystemVSegments::info(m_board.key());
  if (!segment || segment->shmid != m_shmid) {
    return failure(ErrorCode::SystemError,
                   "The blackboard with key " + std::to_string(m_board.key()) +
                       " was removed while " + name() +
                       " was running; run it again and leave the segment alone.");
  }
  return {};
}

/// As a match asks a program that cooperates (docs/robot-programs.md).
Result<void> SeparateProgram::cycle(std::uint64_t tick) {
  if (!m_cooperates) return {};
  const int now = static_cast<int>(tick), done = m_board.read(m_cycle);
  if (done >= 0 || -done >= now) return {};
  std::atomic_thread_fence(std::memory_order_release);  // behind what it reads
  m_board.write(m_cycle, now);
  const auto begin = ProgramTime::now();
  auto looked = begin;
  while (m_board.read(m_cycle) >= 0) {
    const auto time = ProgramTime::now();
    if (time - begin < spinFor) continue;
    std::this_thread::sleep_for(napFor);
    if (time - looked < glance) continue;
    looked = time;
    TRY(look());
    if (!m_goesOn()) return failure(ErrorCode::Conflict, "Cancelled.");
    if (time - begin > ProgramSeconds(m_choice.responseTimeout)) {
      return failure(ErrorCode::SystemError,
                     name() + " did not finish its cycle of tick " + std::to_string(tick) +
                         " within " + inSeconds(ProgramSeconds(m_choice.responseTimeout)));
    }
  }
  std::atomic_thread_fence(std::memory_order_acquire);
  return {};
}

/// Two cycles may lie within a tick, but each has a number of its own.
Result<void> SeparateProgram::run(std::uint64_t tick, double /*seconds*/) {
  if (!m_cooperates) return {};
  const int done = -m_board.read(m_cycle);
  return cycle(std::max(tick, static_cast<std::uint64_t>(std::max(done, 0)) + 1));
}

/// As fast as possible begins at ×1 and doubles as long as the program keeps up.
double SeparateProgram::allowedSpeed(double wanted) {
  if (m_cooperates) return wanted;
  const ProcessStatus* status = m_processes.status(m_id);
  if (!status) return 1.0;
  if (status->clock != ProcessClock::Match) return wanted > 0.0 ? std::min(wanted, 1.0) : 1.0;
  if (wanted > 0.0) {
    return fallsBehind(*status) ? std::min(wanted, status->achieved) : wanted;
  }
  const auto now = ProgramTime::now();
  if (m_searched == ProgramTime::time_point{}) m_searched = now;
  if (now - m_searched < 1s) return m_speed;
  m_searched = now;
  if (fallsBehind(*status)) {
    m_speed = std::max(0.1, status->achieved);
  } else if (status->achieved > 0.0) {
    m_speed = std::min(m_speed * searchFactor, fastestSearched);
  }
  return m_speed;
}

Result<void> SeparateProgram::lookAfter(double seconds, double speed) {
  TRY(look());
  m_processes.setTime(seconds, speed, ProgramTime::now());
  return {};
}

}  // namespace

Result<std::unique_ptr<RerunProgram>> separateProgram(const RerunChoice& choice,
                                                      const RerunRobot& robot,
                                                      const ProgramPlace& place) {
  auto program = std::make_unique<SeparateProgram>(choice, place);
  TRY(program->start(robot, *place.catalog));
  return program;
}

}  // namespace pitchboard::link
