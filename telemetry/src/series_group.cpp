// SPDX-License-Identifier: GPL-3.0-or-later
#include "series_group.h"

namespace pitchboard::telemetry::series {

Group::Group(std::shared_ptr<const Layout> layout) {
  m_next.layout = std::move(layout);
  clear();
}

bool Group::fits(const RowView& row) const {
  return std::isfinite(row.time) && row.words.size() == m_next.layout->words &&
         row.values.size() == m_next.layout->values;
}

bool Group::put(const RowView& row) {
  m_lastTime = row.time;
  m_any = true;
  return m_staging->put(row, *m_next.layout);
}

void Group::newStaging() {
  m_staging = std::make_shared<Staging>(*m_next.layout);
  m_next.staging = m_staging;
}

void Group::addBlock() {
  m_next.blocks.push_back(Chunk::ofStaging(*m_staging, *m_next.layout));
  m_bytes += m_next.blocks.back()->bytes();
  newStaging();
  if (m_next.blocks.size() < chunkBlocks) return;
  auto full = std::make_shared<ChunkList>();
  full->chunks.reserve(m_next.full->chunks.size() + 1);
  full->firstTimes.reserve(m_next.full->chunks.size() + 1);
  full->chunks = m_next.full->chunks;
  full->firstTimes = m_next.full->firstTimes;
  full->chunks.push_back(Chunk::join(m_next.blocks, *m_next.layout));
  full->firstTimes.push_back(full->chunks.back()->times()[0]);
  for (const auto& block : m_next.blocks) m_bytes -= block->bytes();
  m_bytes += full->chunks.back()->bytes();
  m_next.full = std::move(full);
  m_next.blocks.clear();
}

void Group::countBytes() {
  m_bytes = m_staging->bytes;
  for (const auto& chunk : m_next.full->chunks) m_bytes += chunk->bytes();
  for (const auto& chunk : m_next.blocks) m_bytes += chunk->bytes();
}

void Group::publish() {
  auto state = std::make_shared<const State>(m_next);
  {
    const std::lock_guard lock(m_mutex);
    m_state.swap(state);
  }   // the former state ends here, without the lock
}

void Group::closeBlock() {
  addBlock();
  publish();
}

void Group::truncate(double time) {
  const auto now = view();
  const std::size_t keep = now->rowsBefore(time);
  const std::size_t fullRows = m_next.full->chunks.size() * chunkRows;
  const std::size_t wholeRows = keep < fullRows ? keep / chunkRows * chunkRows
                                                : fullRows + (keep - fullRows) / blockRows * blockRows;
  if (wholeRows < fullRows) {
    auto full = std::make_shared<ChunkList>(*m_next.full);
    full->chunks.resize(wholeRows / chunkRows);
    full->firstTimes.resize(wholeRows / chunkRows);
    m_next.full = std::move(full);
    m_next.blocks.clear();
  } else {
    m_next.blocks.resize((wholeRows - fullRows) / blockRows);
  }
  newStaging();
  countBytes();
  m_any = keep > 0;
  // The rows of the chunk that was cut are put in again; readers see the result at once.
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  for (std::size_t row = wholeRows; row < keep; ++row) {
    m_lastTime = now->row(row, words, values);
    if (!m_staging->put({m_lastTime, words, values}, *m_next.layout)) addBlock();
  }
  if (keep > 0 && wholeRows == keep) m_lastTime = now->row(keep - 1, words, values);
  publish();
}

void Group::clear() {
  m_next.full = std::make_shared<ChunkList>();
  m_next.blocks.clear();
  newStaging();
  countBytes();
  m_any = false;
  publish();
}

void Group::setLayout(std::shared_ptr<const Layout> layout) {
  m_next.layout = std::move(layout);
  publish();
}

std::optional<double> Group::oldestTime() const {
  if (!m_next.full->chunks.empty()) return m_next.full->firstTimes.front();
  if (!m_next.blocks.empty()) return m_next.blocks.front()->times()[0];
  return std::nullopt;
}

void Group::dropOldest() {
  if (m_next.full->chunks.empty()) {
    m_bytes -= m_next.blocks.front()->bytes();
    m_next.blocks.erase(m_next.blocks.begin());
  } else {
    m_bytes -= m_next.full->chunks.front()->bytes();
    auto full = std::make_shared<ChunkList>();
    full->chunks.assign(m_next.full->chunks.begin() + 1, m_next.full->chunks.end());
    full->firstTimes.assign(m_next.full->firstTimes.begin() + 1, m_next.full->firstTimes.end());
    m_next.full = std::move(full);
  }
  publish();
}

std::shared_ptr<const View> Group::view() const {
  std::shared_ptr<const State> state;
  {
    const std::lock_guard lock(m_mutex);
    state = m_state;
  }
  return std::make_shared<const View>(std::move(state));
}

}  // namespace pitchboard::telemetry::series
