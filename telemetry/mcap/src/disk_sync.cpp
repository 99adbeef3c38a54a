// SPDX-License-Identifier: GPL-3.0-or-later
#include "disk_sync.h"

#include <utility>

#include <base/try.h>

namespace pitchboard::telemetry {

DiskSync::DiskSync(std::function<Result<void>()> sync)
    : m_sync(std::move(sync)), m_thread([this] { run(); }) {}

DiskSync::~DiskSync() {
  {
    const std::lock_guard lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_one();
  m_thread.join();
}

void DiskSync::run() {
  std::unique_lock lock(m_mutex);
  for (;;) {
    m_wake.wait(lock, [this] { return m_stop || m_asked; });
    if (m_stop) return;
    m_running = std::exchange(m_asked, std::nullopt);
    lock.unlock();
    const auto done = m_sync();
    lock.lock();
    m_running.reset();
    if (!done && !m_error) m_error = done.error();
    m_settled.notify_all();
  }
}

Result<void> DiskSync::request() {
  const std::lock_guard lock(m_mutex);
  if (m_error) return tl::unexpected(*m_error);
  if (!m_asked) m_asked = Clock::now();
  m_wake.notify_one();
  return {};
}

Result<void> DiskSync::finish() {
  TRY(request());
  std::unique_lock lock(m_mutex);
  m_settled.wait(lock, [this] { return m_error || (!m_asked && !m_running); });
  if (m_error) return tl::unexpected(*m_error);
  return {};
}

double DiskSync::syncLatency() const {
  const std::lock_guard lock(m_mutex);
  const auto since = m_running ? m_running : m_asked;
  return since ? std::chrono::duration<double>(Clock::now() - *since).count() : 0.0;
}

}  // namespace pitchboard::telemetry
