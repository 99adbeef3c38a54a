// SPDX-License-Identifier: GPL-3.0-or-later
#include "series_group.h"

#include <algorithm>

namespace pitchboard::telemetry::series {

Group::Group(std::shared_ptr<const Layout> layout) {
  setInputSize(layout->info.columns);
  m_next.layout = std::move(layout);
  empty();
}

Group::Group(std::shared_ptr<const State> state) : m_next(*state), m_state(std::move(state)) {
  countBytes();
}

std::unique_ptr<Group> Group::branch() const {
  const std::lock_guard lock(m_mutex);
  return std::unique_ptr<Group>(new Group(m_state));
}

Group::Put Group::put(const RowView& given) {
  const std::lock_guard lock(m_write);
  if (!m_staging || !std::isfinite(given.time) || given.words.size() != m_inputWords ||
      given.values.size() != m_inputValues) {
    return Put::Refused;
  }
  if (m_any && given.time < m_lastTime) return Put::GoesBack;
  m_lastTime = given.time;
  m_any = true;
  const RowView row = m_input.convert(given, m_words, m_values);
  return m_staging->put(row, *m_next.layout) ? Put::Done : Put::BlockFull;
}

void Group::newStaging() {
  m_staging = std::make_shared<Staging>(*m_next.layout);
  m_next.staging = m_staging;
}

void Group::addBlock() {
  m_next.blocks.emplace_back(Chunk::ofStaging(*m_staging, *m_next.layout));
  m_bytes += m_next.blocks.back().chunk->bytes();
  newStaging();
  if (m_next.blocks.size() < chunkBlocks) return;
  auto full = std::make_shared<Units>();
  full->reserve(m_next.full->size() + 1);
  *full = *m_next.full;
  full->emplace_back(Chunk::join(m_next.blocks, *m_next.layout));
  for (const ChunkView& block : m_next.blocks) m_bytes -= block.chunk->bytes();
  m_bytes += full->back().chunk->bytes();
  m_next.full = std::move(full);
  m_next.blocks.clear();
}

void Group::countBytes() {
  m_bytes = m_next.staging->bytes;
  for (const ChunkView& unit : *m_next.full) m_bytes += unit.chunk->bytes();
  for (const ChunkView& unit : m_next.blocks) m_bytes += unit.chunk->bytes();
}

void Group::publish() {
  auto state = std::make_shared<const State>(m_next);
  {
    const std::lock_guard lock(m_mutex);
    m_state.swap(state);
  }  // the former state ends here, without the lock
}

void Group::closeBlock() {
  const std::lock_guard lock(m_write);
  if (m_staging->rows.load(std::memory_order_relaxed) < blockRows) return;  // cleared meanwhile
  addBlock();
  publish();
}

void Group::truncate(double time) {
  const std::lock_guard lock(m_write);
  const auto now = view();
  const std::size_t keep = now->rowsBefore(time);
  const std::size_t fullRows = m_next.full->size() * chunkRows;
  const std::size_t wholeRows = keep < fullRows
                                    ? keep / chunkRows * chunkRows
                                    : fullRows + (keep - fullRows) / blockRows * blockRows;
  if (wholeRows < fullRows) {
    auto full = std::make_shared<Units>(*m_next.full);
    full->resize(wholeRows / chunkRows);
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
  const std::lock_guard lock(m_write);
  empty();
}

void Group::empty() {
  m_next.full = std::make_shared<Units>();
  m_next.blocks.clear();
  newStaging();
  countBytes();
  m_any = false;
  publish();
}

bool Group::setInfo(const GroupInfo& info) {
  const std::lock_guard lock(m_write);
  if (info == (m_given ? *m_given : m_next.layout->info)) return false;
  const auto layout = std::make_shared<const Layout>(
      GroupInfo{info.name, mergedColumns(m_next.layout->info.columns, info.columns), info.robot,
                info.match, info.id});
  const bool isSame = std::ranges::equal(layout->info.columns, m_next.layout->info.columns,
                                         [](const ColumnInfo& a, const ColumnInfo& b) {
                                           return a.type == b.type && a.lost == b.lost;
                                         });
  m_input = RowMap(info.columns, layout->info.columns);
  m_given.reset();
  if (!m_input.isIdentity()) m_given = std::make_unique<const GroupInfo>(info);
  setInputSize(info.columns);
  if (isSame)
    m_next.layout = layout;
  else
    convertTo(layout);
  publish();
  return true;
}

void Group::describe(const GroupInfo& now) {
  const std::lock_guard lock(m_write);
  const auto described = [&](GroupInfo info) {
    info.name = now.name;
    info.robot = now.robot;
    info.match = now.match;
    return info;
  };
  if (m_given) m_given = std::make_unique<const GroupInfo>(described(*m_given));
  m_next.layout = std::make_shared<const Layout>(described(m_next.layout->info));
  publish();
}

void Group::setInputSize(const std::vector<ColumnInfo>& columns) {
  m_inputValues =
      static_cast<std::size_t>(std::ranges::count(columns, ColumnType::Float64, &ColumnInfo::type));
  m_inputWords = columns.size() - m_inputValues;
}

/// Under m_write.
void Group::convertTo(const std::shared_ptr<const Layout>& layout) {
  const auto now = view();
  const std::size_t staged = m_staging->rows.load(std::memory_order_relaxed);
  const auto converted = [&](const ChunkView& unit) {
    return ChunkView(unit.chunk->converted(*m_next.layout, *layout));
  };
  auto full = std::make_shared<Units>();
  full->reserve(m_next.full->size());
  for (const ChunkView& unit : *m_next.full) full->push_back(converted(unit));
  m_next.full = std::move(full);
  for (ChunkView& unit : m_next.blocks) unit = converted(unit);
  const RowMap map(m_next.layout->info.columns, layout->info.columns);
  m_next.layout = layout;
  newStaging();
  countBytes();
  std::vector<std::uint32_t> words;
  std::vector<double> values;
  for (std::size_t row = now->rows() - staged; row < now->rows(); ++row) {
    const double time = now->row(row, words, values);
    m_staging->put(map.convert({time, words, values}, m_words, m_values), *m_next.layout);
  }
}

std::optional<double> Group::endOfOldest() const {
  if (!m_next.full->empty()) return m_next.full->front().last;
  if (!m_next.blocks.empty()) return m_next.blocks.front().last;
  return std::nullopt;
}

void Group::dropOldest() {
  if (m_next.full->empty()) {
    m_bytes -= m_next.blocks.front().chunk->bytes();
    m_next.blocks.erase(m_next.blocks.begin());
  } else {
    m_bytes -= m_next.full->front().chunk->bytes();
    m_next.full = std::make_shared<Units>(m_next.full->begin() + 1, m_next.full->end());
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
