// SPDX-License-Identifier: GPL-3.0-or-later
#include "series_chunk.h"

#include <array>

namespace pitchboard::telemetry::series {

Staging::Staging(const Layout& layout)
    : times(std::make_unique_for_overwrite<double[]>(blockRows)),
      words(std::make_unique_for_overwrite<std::uint32_t[]>(std::size_t{blockRows} *
                                                            layout.keptWords)),
      values(std::make_unique_for_overwrite<double[]>(std::size_t{blockRows} * layout.keptValues)),
      bytes(sizeof(Staging) + blockRows * (8 + std::size_t{4} * layout.keptWords +
                                           std::size_t{8} * layout.keptValues)) {}

bool Staging::put(const RowView& row, const Layout& layout) {
  const std::uint32_t at = rows.load(std::memory_order_relaxed);
  times[at] = row.time;
  auto* word = std::ranges::copy(row.words, words.get() + std::size_t{at} * layout.keptWords).out;
  auto* value =
      std::ranges::copy(row.values, values.get() + std::size_t{at} * layout.keptValues).out;
  for (const Losable& one : layout.losable) {
    const bool isLost = one.isLost(row);
    if (one.slot.type == ColumnType::Float64)
      *value++ = isLost ? std::numeric_limits<double>::quiet_NaN() : row.values[one.slot.index];
    else
      *word++ = isLost ? std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN())
                       : row.words[one.slot.index];
  }
  rows.store(at + 1, std::memory_order_release);
  return at + 1 < blockRows;
}

namespace {

/// Turns the rows of a staging block into columns, some neighbours at a time so that each cache
/// line of the rows is read once.
template <class Word, class Take>
void transpose(const Word* rows, std::uint32_t width, const Take& take) {
  constexpr std::uint32_t stripe = 64 / sizeof(Word);
  std::array<std::array<Word, blockRows>, stripe> lanes;
  for (std::uint32_t begin = 0; begin < width; begin += stripe) {
    const std::uint32_t count = std::min(stripe, width - begin);
    for (std::uint32_t row = 0; row < blockRows; ++row) {
      const Word* from = rows + std::size_t{row} * width + begin;
      for (std::uint32_t lane = 0; lane < count; ++lane) lanes[lane][row] = from[lane];
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) take(begin + lane, lanes[lane]);
  }
}

}  // namespace

std::shared_ptr<const Chunk> Chunk::ofStaging(const Staging& full, const Layout& layout) {
  auto chunk = std::make_shared<Chunk>();
  chunk->m_times.assign(full.times.get(), full.times.get() + blockRows);
  chunk->m_columns.resize(layout.slots.size());
  transpose(full.words.get(), layout.keptWords,
            [&](std::uint32_t index, const std::array<std::uint32_t, blockRows>& words) {
              const std::uint32_t c = layout.wordColumns[index];
              if (layout.slots[c].type == ColumnType::Int32) {
                const auto typed = std::bit_cast<std::array<std::int32_t, blockRows>>(words);
                chunk->m_columns[c] = Column::ofBlock(typed.data());
              } else {
                const auto typed = std::bit_cast<std::array<float, blockRows>>(words);
                chunk->m_columns[c] = Column::ofBlock(typed.data());
              }
            });
  transpose(full.values.get(), layout.keptValues,
            [&](std::uint32_t index, const std::array<double, blockRows>& values) {
              chunk->m_columns[layout.valueColumns[index]] = Column::ofBlock(values.data());
            });
  chunk->count(layout);
  return chunk;
}

std::shared_ptr<const Chunk> Chunk::join(std::span<const ChunkView> blocks, const Layout& layout) {
  auto chunk = std::make_shared<Chunk>();
  chunk->m_times.reserve(chunkRows);
  for (const auto& block : blocks) {
    chunk->m_times.insert(chunk->m_times.end(), block.times, block.times + blockRows);
  }
  chunk->m_columns.reserve(layout.slots.size());
  std::array<const Column*, chunkBlocks> parts{};
  for (std::uint32_t c = 0; c < layout.slots.size(); ++c) {
    for (std::size_t b = 0; b < chunkBlocks; ++b) parts[b] = &blocks[b].columns[c];
    withType(layout.slots[c].type,
             [&](auto zero) { chunk->m_columns.push_back(Column::join<decltype(zero)>(parts)); });
  }
  chunk->count(layout);
  return chunk;
}

std::shared_ptr<const Chunk> Chunk::converted(const Layout& from, const Layout& to) const {
  auto chunk = std::make_shared<Chunk>();
  chunk->m_times = m_times;
  chunk->m_columns.reserve(to.slots.size());
  const auto take = [&](std::uint32_t slot, ColumnType type) {
    chunk->m_columns.push_back(withType(from.slots[slot].type, [&](auto zero) {
      using T = decltype(zero);
      return from.slots[slot].type == type ? m_columns[slot].copy<T>(blocks())
                                           : m_columns[slot].numbers<T>(blocks());
    }));
  };
  for (std::uint32_t c = 0; c < to.info.columns.size(); ++c) {
    if (from.hasColumn(c))
      take(c, to.slots[c].type);
    else
      chunk->m_columns.push_back(Column::ofConstant(std::numeric_limits<double>::quiet_NaN()));
  }
  for (const Losable& one : to.losable) {
    if (from.hasColumn(one.column))
      take(from.shown(one.column), one.slot.type);
    else
      chunk->m_columns.push_back(Column::ofConstant(std::numeric_limits<double>::quiet_NaN()));
  }
  chunk->count(to);
  return chunk;
}

void Chunk::count(const Layout& layout) {
  m_bytes = sizeof(Chunk) + m_times.capacity() * sizeof(double) + m_columns.size() * sizeof(Column);
  for (std::uint32_t c = 0; c < layout.slots.size(); ++c) {
    withType(layout.slots[c].type,
             [&](auto zero) { m_bytes += m_columns[c].heapBytes<decltype(zero)>(blocks()); });
  }
}

}  // namespace pitchboard::telemetry::series
