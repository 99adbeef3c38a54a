// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_loop.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <base/try.h>
#include <robotlink/processes/lock_step_orders.h>

namespace pitchboard::robot {
namespace {

using Clock = std::chrono::steady_clock;

sigset_t endSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

class Display {
 public:
  Display(RobotId robot, link::CognitionDebugSender* sender) : m_robot(robot), m_sender(sender) {}

  /// Sends the debug data of the process, unless it was sent less than `period` ago.
  void send(const link::CognitiveProcess& process, std::chrono::milliseconds period) {
    const Clock::time_point now = Clock::now();
    if (m_sender == nullptr || now < m_last + period) return;
    link::CognitionDebug cognitionDebug;
    cognitionDebug.robot = m_robot;
    process.sendDebugData(cognitionDebug);
    m_sender->send(cognitionDebug);
    m_last = now;
  }

 private:
  RobotId m_robot;
  link::CognitionDebugSender* m_sender;
  Clock::time_point m_last{};
};

constexpr std::chrono::milliseconds displayPeriod{200};

/// Nobody writes while the match waits: what is read in this time are the inputs of an announced
/// cycle, and then its outputs.
constexpr std::chrono::milliseconds readingTime{10};

/// Runs one cycle, and announces it if there is an announcer.
void step(link::CognitiveProcess& process, link::Blackboard& board, double seconds,
          link::CycleAnnouncer* announcer, std::chrono::milliseconds reading) {
  if (announcer == nullptr) return process.step(board, {seconds});
  const double announced = announcer->begin(seconds);
  std::this_thread::sleep_for(reading);
  process.step(board, {announced});
  announcer->end();
  std::this_thread::sleep_for(reading);
}

}  // namespace

void holdEndSignals() {
  const sigset_t signals = endSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

bool stopRequested(std::chrono::nanoseconds wait) {
  const sigset_t signals = endSignals();
  const Clock::time_point end = Clock::now() + wait;
  while (true) {
    // Waiting for the signal itself: one that arrives just before the wait is not missed.
    const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::max(end - Clock::now(), Clock::duration::zero()));
    constexpr std::int64_t second = 1'000'000'000;
    const timespec time{static_cast<time_t>(rest.count() / second),
                        static_cast<long>(rest.count() % second)};
    if (sigtimedwait(&signals, nullptr, &time) > 0) return true;
    if (errno == EAGAIN) return false;
  }
}

void runUntilStopped(link::CognitiveProcess& process, link::Blackboard& board, RobotId robot,
                     link::CognitionDebugSender* display, link::CycleAnnouncer* announcer) {
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(process.period()));
  const Clock::time_point start = Clock::now();
  Clock::time_point next = start;
  Display shown(robot, display);
  while (true) {
    step(process, board, std::chrono::duration<double>(Clock::now() - start).count(), announcer,
         std::chrono::milliseconds(0));
    shown.send(process, displayPeriod);
    next += period;
    const Clock::time_point now = Clock::now();
    if (next < now) next += (now - next) / period * period + period;

    if (stopRequested(next - Clock::now())) break;
  }
  process.finish();
}

Result<void> runInLockStep(std::unique_ptr<link::CognitiveProcess> process,
                           const ProcessMaker& make, link::Blackboard& board, RobotId robot,
                           link::LockStepSlot& slot, link::CognitionDebugSender* display,
                           link::CycleAnnouncer* announcer) {
  // While the match is paused: how soon a signal is noticed, and how often debug data is sent
  // again, because displays drop data that is not repeated.
  constexpr std::chrono::milliseconds maxWait{100}, refreshPeriod{1000};
  Display shown(robot, display);
  slot.ready(process->period());
  double last = 0.0;
  while (true) {
    const auto cycle = slot.wait(maxWait);
    if (cycle) {
      const auto messages = slot.messages();
      const bool isTold = !messages.empty() && messages.front() == link::beginAnewOrder;
      if (isTold || cycle->seconds < last) {
        process.reset();  // its ports are free again
        process = TRY(make());
        process->resume(board);
      }
      last = cycle->seconds;
      step(*process, board, last, announcer,
           slot.inLockStep() ? readingTime : std::chrono::milliseconds(0));
      slot.done();
    }
    shown.send(*process, cycle ? displayPeriod : refreshPeriod);
    sigset_t pending;
    sigpending(&pending);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
      if (sigismember(&pending, signal) == 0) continue;
      process->finish();
      return {};
    }
  }
}

}  // namespace pitchboard::robot
