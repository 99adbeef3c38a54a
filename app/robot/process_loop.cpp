// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_loop.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>

namespace pitchboard::robot {
namespace {

sigset_t endSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

}  // namespace

void holdEndSignals() {
  const sigset_t signals = endSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

bool askedToEnd(std::chrono::nanoseconds wait) {
  using Clock = std::chrono::steady_clock;
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

void runUntilAsked(link::CognitiveProcess& process, link::Blackboard& board, RobotId robot,
                   link::ThoughtsSender* display) {
  constexpr std::chrono::milliseconds displayPeriod{200};
  using Clock = std::chrono::steady_clock;
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(process.period()));
  const Clock::time_point start = Clock::now();
  Clock::time_point next = start, nextDisplay = start;
  while (true) {
    process.step(board, {std::chrono::duration<double>(Clock::now() - start).count()});
    if (display != nullptr && Clock::now() >= nextDisplay) {
      link::RobotThoughts thoughts;
      thoughts.robot = robot;
      process.tellThoughts(thoughts);
      display->send(thoughts);
      nextDisplay = Clock::now() + displayPeriod;
    }
    next += period;
    const Clock::time_point now = Clock::now();
    if (next < now) next += (now - next) / period * period + period;

    if (askedToEnd(next - Clock::now())) return;
  }
}

}  // namespace pitchboard::robot
