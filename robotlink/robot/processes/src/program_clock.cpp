// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/program_clock.h>

#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <thread>

#include <base/system_reason.h>
#include <robotlink/processes/team_program.h>

#include "time_page.h"

namespace pitchboard::link {

Result<std::unique_ptr<ProgramClock>> ProgramClock::create() {
  const std::string file =
      besideTeamProgram(std::string("../" PITCHBOARD_LIBRARY_FOLDER "/") + library);
  if (::access(file.c_str(), R_OK) != 0) {
    return failure(ErrorCode::NotFound, "Cannot read " + file + ": " + systemReason(errno) +
                                            ". Without it, programs use real time.");
  }
  UniqueFd memory(::memfd_create("pitchboard-time", MFD_CLOEXEC));
  if (!memory || ::ftruncate(memory.get(), sizeof(pitchboard_time_page)) != 0) {
    return failure(ErrorCode::SystemError,
                   "Cannot share the time with a program: " + systemReason(errno));
  }
  void* page = ::mmap(nullptr, sizeof(pitchboard_time_page), PROT_READ | PROT_WRITE, MAP_SHARED,
                      memory.get(), 0);
  if (page == MAP_FAILED) {
    return failure(ErrorCode::SystemError,
                   "Cannot share the time with a program: " + systemReason(errno));
  }
  return std::unique_ptr<ProgramClock>(
      new ProgramClock(file, std::move(memory), static_cast<pitchboard_time_page*>(page)));
}

ProgramClock::ProgramClock(std::string path, UniqueFd file, pitchboard_time_page* page)
    : m_library(std::move(path)), m_file(std::move(file)), m_page(page) {}

ProgramClock::~ProgramClock() {
  ::munmap(m_page, sizeof *m_page);
}

std::vector<std::pair<std::string, std::string>> ProgramClock::start(double rate, Time now) {
  m_started = now;
  write(std::chrono::nanoseconds(0), rate, now);
  const char* before = std::getenv("LD_PRELOAD");
  const std::string others =
      before != nullptr && *before != '\0' ? ' ' + std::string(before) : std::string();
  return {{"LD_PRELOAD", m_library + others},
          {PITCHBOARD_TIME_VARIABLE,
           "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(m_file.get())}};
}

void ProgramClock::setRate(double rate, Time now) {
  const long woken = write(offset(now), rate, now);
  if (rate != 0.0) return;
  // The caller is about to stop the programs. A timer that a program has not set again by then
  // would run out during the pause. A program that was woken sleeps again once it has set its
  // timers; requeuing sleepers onto the same futex counts them.
  constexpr std::chrono::milliseconds patience{200}, look{1};
  const auto isDone = [&] {
    const auto all = static_cast<std::uintptr_t>(INT_MAX);
    const long asleep = ::syscall(SYS_futex, &m_page->sequence, FUTEX_CMP_REQUEUE, 0, all,
                                  &m_page->sequence, m_page->sequence);
    return asleep < 0 || asleep >= woken;
  };
  const auto last = std::chrono::steady_clock::now() + patience;
  while (!isDone() && std::chrono::steady_clock::now() < last) std::this_thread::sleep_for(look);
}

double ProgramClock::rate() const {
  return m_page->rate;
}

double ProgramClock::seconds(Time now) const {
  return std::chrono::duration<double>(now - m_started + offset(now)).count();
}

/// By how much the program's clocks are ahead of the computer's.
std::chrono::nanoseconds ProgramClock::offset(Time now) const {
  const double passed =
      static_cast<double>(now.time_since_epoch().count() - m_page->since) * (m_page->rate - 1.0);
  return std::chrono::nanoseconds(m_page->offset + static_cast<std::int64_t>(passed));
}

double ProgramClock::rateFor(double behind, double speed) {
  constexpr double rightSeconds = 0.02, correctionSeconds = 1.0;
  // At a higher speed the same time of the computer is more of the match's.
  if (std::abs(behind) <= rightSeconds * std::max(1.0, speed)) return speed;
  return std::clamp(speed + behind / correctionSeconds, 0.5 * speed, 2.0 * speed);
}

long ProgramClock::write(std::chrono::nanoseconds offset, double rate, Time now) {
  // steady_clock is CLOCK_MONOTONIC.
  static_assert(std::is_same_v<Time::duration, std::chrono::nanoseconds>);
  const std::atomic_ref sequence(m_page->sequence);
  const auto store = [](auto& value, auto to) {
    std::atomic_ref(value).store(to, std::memory_order_relaxed);
  };
  sequence.fetch_add(1, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  store(m_page->since, static_cast<std::int64_t>(now.time_since_epoch().count()));
  store(m_page->offset, static_cast<std::int64_t>(offset.count()));
  store(m_page->rate, rate);
  sequence.fetch_add(1, std::memory_order_release);
  return ::syscall(SYS_futex, &m_page->sequence, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace pitchboard::link
