// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_team.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace pitchboard::link {
namespace {

// Pieces of work; small enough that no thread waits long at the end.
constexpr std::size_t atLeast = 4, atMost = 16;

using RealTime = std::chrono::steady_clock;
// To wake a thread and to wait for it costs some tens of microseconds.
constexpr StepTeam::Seconds minShared(120e-6);

}  // namespace

Result<void> StepTeam::start(int threads) {
  try {
    for (int i = 1; i < threads; ++i) {
      m_threads.emplace_back([this, i] { serve(static_cast<std::size_t>(i)); });
    }
  } catch (const std::system_error& error) {
    return failure(ErrorCode::SystemError, "the system allows only " +
                                               std::to_string(m_threads.size() + 1) +
                                               " threads; ask for fewer (" + error.what() + ")");
  }
  return {};
}

StepTeam::~StepTeam() {
  {
    const std::lock_guard lock(m_mutex);
    m_ends = true;
  }
  m_begun.notify_all();
  for (std::thread& thread : m_threads) thread.join();
}

bool StepTeam::isWorthSharing(std::size_t pieces, std::size_t units, Seconds perUnit) {
  if (pieces <= 1) return false;
  return perUnit == Seconds{} || perUnit * static_cast<double>(pieces * units) > minShared;
}

void StepTeam::run(std::size_t pieces, std::size_t units, const Work& work) {
  if (m_threads.empty()) return work(0, 0, pieces);
  const auto begin = RealTime::now();
  const auto remember = [&](std::size_t done) {
    const auto all = static_cast<double>(done * units);
    if (all > 0.0) m_perUnit = Seconds(RealTime::now() - begin) / all;
  };
  if (!isWorthSharing(pieces, units, m_perUnit)) {
    work(0, 0, pieces);
    return remember(pieces);
  }
  {
    const std::lock_guard lock(m_mutex);
    m_work = &work;
    m_pieces = pieces;
    m_atOnce = std::clamp(pieces / 64, atLeast, atMost);
    m_next = 0;
    m_busy = m_threads.size();
    ++m_round;
  }
  m_begun.notify_all();
  remember(takePieces(0));
  std::unique_lock lock(m_mutex);
  m_done.wait(lock, [this] { return m_busy == 0; });
}

void StepTeam::serve(std::size_t worker) {
  std::size_t round = 0;
  while (true) {
    {
      std::unique_lock lock(m_mutex);
      m_begun.wait(lock, [&] { return m_ends || m_round != round; });
      if (m_ends) return;
      round = m_round;
    }
    takePieces(worker);
    const std::lock_guard lock(m_mutex);
    if (--m_busy == 0) m_done.notify_one();
  }
}

std::size_t StepTeam::takePieces(std::size_t worker) {
  std::size_t taken = 0;
  while (true) {
    const std::size_t first = m_next.fetch_add(m_atOnce);
    if (first >= m_pieces) return taken;
    const std::size_t last = std::min(first + m_atOnce, m_pieces);
    (*m_work)(worker, first, last);
    taken += last - first;
  }
}

}  // namespace pitchboard::link
