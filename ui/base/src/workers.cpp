// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/workers.h>

#include <algorithm>
#include <utility>

namespace pitchboard::ui {

Workers::Workers(std::size_t threads) : m_most(threads) {}

Workers::~Workers() {
  {
    const std::lock_guard lock(m_mutex);
    m_ending = true;
  }
  m_wake.notify_all();
  for (std::thread& thread : m_threads) thread.join();
}

void Workers::start(Work work) {
  const std::lock_guard lock(m_mutex);
  add(std::move(work));
}

bool Workers::tryStart(Work work) {
  const std::lock_guard lock(m_mutex);
  if (m_waiting.size() + m_busy >= m_most) return false;
  add(std::move(work));
  return true;
}

void Workers::add(Work work) {
  m_waiting.push_back(std::move(work));
  const bool enough = m_waiting.size() + m_busy <= m_threads.size();
  if (!enough && m_threads.size() < m_most) m_threads.emplace_back([this] { run(); });
  m_wake.notify_one();
}

void Workers::waitForDone() {
  std::unique_lock lock(m_mutex);
  m_done.wait(lock, [this] { return m_waiting.empty() && m_busy == 0; });
}

void Workers::run() {
  std::unique_lock lock(m_mutex);
  while (true) {
    m_wake.wait(lock, [this] { return m_ending || !m_waiting.empty(); });
    if (m_waiting.empty()) return;
    Work work = std::exchange(m_waiting.front(), {});
    m_waiting.pop_front();
    ++m_busy;
    lock.unlock();
    work();
    work = {};  // what it holds goes before it counts as done
    lock.lock();
    --m_busy;
    if (m_waiting.empty() && m_busy == 0) m_done.notify_all();
  }
}

Workers& sharedWorkers() {
  static Workers workers(std::max(1U, std::thread::hardware_concurrency()));
  return workers;
}

}  // namespace pitchboard::ui
