// SPDX-License-Identifier: GPL-3.0-or-later
#include "cycle_watch.h"

#include <linux/futex.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <ctime>
#include <thread>

#include <robotlink/blackboard/cycle_words.h>

namespace pitchboard::agent {
namespace {

// Since Linux 5.16; older headers do not have it.
constexpr long futexWaitv = 449;
constexpr std::uint32_t word32 = 2;
constexpr std::size_t maxWaiters = 128;
struct Waiter {
  std::uint64_t value = 0, address = 0;
  std::uint32_t flags = word32, reserved = 0;
};

timespec timeOf(Time time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {static_cast<time_t>(seconds.count()),
          static_cast<long>(std::chrono::nanoseconds(time - seconds).count())};
}

}  // namespace

CycleWatch::CycleWatch(std::span<const link::Variable> all, int key) : m_key(key) {
  for (std::size_t i = 0; i < all.size() && m_words.size() < maxWaiters; ++i) {
    if (!link::announcesCycles(all[i])) continue;
    m_places.push_back(i);
    m_words.push_back(static_cast<std::size_t>(all[i].index));
  }
}

CycleWatch::~CycleWatch() {
  detach();
}

void CycleWatch::detach() {
  if (m_board != nullptr) ::shmdt(m_board);
  m_board = nullptr;
}

void CycleWatch::attach() {
  if (m_words.empty()) return;
  detach();
  const int id = ::shmget(m_key, 0, 0);
  shmid_ds info{};
  if (id < 0 || ::shmctl(id, IPC_STAT, &info) != 0) return;
  const std::size_t last = *std::ranges::max_element(m_words);
  if (info.shm_segsz < sizeof(std::uint32_t) * (last + 1)) return;
  void* const address = ::shmat(id, nullptr, SHM_RDONLY);
  if (address != reinterpret_cast<void*>(-1)) m_board = static_cast<const std::uint32_t*>(address);
}

void CycleWatch::take(const std::vector<std::uint32_t>& words) {
  m_known.clear();
  if (words.empty()) return;
  for (const std::size_t place : m_places) m_known.push_back(words[place]);
}

void CycleWatch::await(Time now, Time tick) {
  using Clock = std::chrono::steady_clock;
  const auto sleepUntil = [](Time time) { std::this_thread::sleep_until(Clock::time_point(time)); };
  if (m_board == nullptr || m_known.empty() || now + minStep >= tick) return sleepUntil(tick);
  awaitChange(now, tick);
  sleepUntil(now + minStep);
}

void CycleWatch::awaitChange(Time now, Time tick) const {
  if (m_words.size() > 1) {
    std::vector<Waiter> waiters;
    for (std::size_t i = 0; i < m_words.size(); ++i) {
      waiters.push_back({m_known[i], reinterpret_cast<std::uint64_t>(m_board + m_words[i])});
    }
    const timespec until = timeOf(tick);
    const long done = ::syscall(futexWaitv, waiters.data(), static_cast<unsigned>(waiters.size()),
                                0U, &until, CLOCK_MONOTONIC);
    if (done >= 0 || errno != ENOSYS) return;
  }
  // An older kernel waits for one of several.
  const timespec length = timeOf(tick - now);
  ::syscall(SYS_futex, m_board + m_words.front(), FUTEX_WAIT, m_known.front(), &length, nullptr, 0);
}

}  // namespace pitchboard::agent
