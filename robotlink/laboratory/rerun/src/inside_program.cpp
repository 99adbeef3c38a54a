// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/try.h>
#include <robotlink/match/due_ticks.h>

#include "feed.h"
#include "rerun_program.h"

namespace pitchboard::link {
namespace {

/// As a match starts it (RobotSlots).
ProcessOptions optionsOf(const RerunChoice& choice, const RerunRobot& robot) {
  ProcessOptions options;
  options.robot = robot.id;
  options.behaviour = choice.hasBehaviour ? choice.behaviour.name : robot.behaviour;
  options.parameters = choice.hasBehaviour ? choice.behaviour.parameters : robot.parameters;
  options.field = robot.field;
  options.model = robot.model;
  options.seed = robot.seed;
  options.facesLeft = robot.facesLeft;
  options.team = static_cast<int>(robot.team);
  options.shirt = robot.shirt;
  options.keepsMemory = false;
  options.teamChannel = robot.teamChannel;
  options.refereeTeam = robot.refereeTeam;
  options.refereeDatagrams = robot.refereeDatagrams;
  options.announceSetPlay = robot.announceSetPlay;
  options.sends = false;
  return options;
}

class InsideProgram final : public RerunProgram {
 public:
  InsideProgram(RerunChoice choice, Blackboard& board, double tickRate)
      : m_choice(std::move(choice)), m_board(board), m_tickRate(tickRate) {}

  Result<void> make(const RerunRobot& robot, std::uint64_t tick) {
    m_process = TRY(findProcess(m_choice.process)->make(optionsOf(m_choice, robot)));
    m_next = nextDueTick(m_process->period(), tick, m_tickRate);
    return {};
  }
  void resume() { m_process->resume(m_board); }

  Result<void> cycle(std::uint64_t tick) override {
    if (tick < m_next) return {};
    m_process->step(m_board, Clock{static_cast<double>(tick) / m_tickRate});
    m_next = nextDueTick(m_process->period(), tick, m_tickRate);
    return {};
  }
  Result<void> run(std::uint64_t, double seconds) override {
    m_process->step(m_board, Clock{seconds});
    return {};
  }
  Result<void> beginAnew(const RerunRobot& robot, std::uint64_t tick) override {
    return make(robot, tick);
  }
  Result<void> changeSides(const RerunRobot& robot, std::uint64_t tick) override {
    return make(robot, tick);
  }
  double allowedSpeed(double wanted) override { return wanted; }
  Result<void> lookAfter(double, double) override { return {}; }
  bool inLockStep() const override { return true; }
  int turn() const override { return turnOf(m_choice.process); }
  const std::string& process() const override { return m_choice.process; }

 private:
  const RerunChoice m_choice;
  Blackboard& m_board;
  const double m_tickRate;
  std::unique_ptr<CognitiveProcess> m_process;
  std::uint64_t m_next = 0;
};

}  // namespace

Result<std::unique_ptr<RerunProgram>> insideProgram(const RerunChoice& choice,
                                                    const RerunRobot& robot, Blackboard& board,
                                                    double tickRate, std::uint64_t tick,
                                                    bool resumes) {
  auto program = std::make_unique<InsideProgram>(choice, board, tickRate);
  TRY(program->make(robot, tick));
  if (resumes) program->resume();
  return program;
}

}  // namespace pitchboard::link
