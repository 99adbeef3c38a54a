// SPDX-License-Identifier: GPL-3.0-or-later
#include "chunks_ahead.h"

#include <utility>

#include <base/byte_sizes.h>

namespace pitchboard::telemetry {
namespace {

/// Chunks that wait; one is read beyond them, whatever its size.
constexpr std::size_t maxReadyBytes = 16 * mebibyte, maxReadyChunks = 8;
constexpr std::size_t maxKeptChunks = 8, maxKeptBytes = 4 * mebibyte;

}  // namespace

ChunksAhead::ChunksAhead(std::size_t count, std::function<void(std::size_t, OpenChunk&)> read)
    : m_count(count), m_read(std::move(read)) {}

ChunksAhead::~ChunksAhead() {
  {
    const std::lock_guard lock(m_mutex);
    m_stop = true;
  }
  m_changed.notify_all();
  if (m_thread.joinable()) m_thread.join();
}

std::unique_ptr<OpenChunk> ChunksAhead::next() {
  if (!m_thread.joinable()) m_thread = std::thread([this] { run(); });
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return !m_ready.empty(); });
  auto chunk = std::move(m_ready.front());
  m_ready.pop_front();
  m_bytes -= chunk->body.size();
  lock.unlock();
  m_changed.notify_all();
  return chunk;
}

void ChunksAhead::giveBack(std::unique_ptr<OpenChunk> chunk) {
  if (chunk->body.capacity() > maxKeptBytes) return;
  chunk->entries.clear();
  chunk->at = 0;
  chunk->passed.clear();
  chunk->unknown = 0;
  chunk->damage.clear();
  const std::lock_guard lock(m_mutex);
  if (m_free.size() < maxKeptChunks) m_free.push_back(std::move(chunk));
}

void ChunksAhead::run() {
  for (std::size_t i = 0; i < m_count; ++i) {
    std::unique_ptr<OpenChunk> chunk;
    {
      std::unique_lock lock(m_mutex);
      m_changed.wait(lock, [this] {
        return m_stop || m_ready.empty() ||
               (m_bytes < maxReadyBytes && m_ready.size() < maxReadyChunks);
      });
      if (m_stop) return;
      if (!m_free.empty()) {
        chunk = std::move(m_free.back());
        m_free.pop_back();
      }
    }
    if (!chunk) chunk = std::make_unique<OpenChunk>();
    m_read(i, *chunk);
    {
      const std::lock_guard lock(m_mutex);
      m_bytes += chunk->body.size();
      m_ready.push_back(std::move(chunk));
    }
    m_changed.notify_all();
  }
}

}  // namespace pitchboard::telemetry
