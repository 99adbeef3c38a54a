// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One column of one chunk. A column that does not change costs 24 bytes; otherwise every block of
// 64 rows that does not change costs its value only, the others are kept raw. Minimum and maximum
// are kept for 64, 512 and 4096 rows, of doubles for 16 too. Private to the library; immutable once
// made.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <span>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "series_layout.h"

namespace pitchboard::telemetry::series {

template <class T>
struct Extremes {
  T min, max;  ///< NaN where there is no other value
};

/// Running minimum and maximum that pass over NaN. Without branches: it begins with limits that any
/// value replaces, and comparisons with NaN are false.
template <class T>
struct MinMax {
  T min = highest(), max = lowest();

  static constexpr T highest() {
    if constexpr (std::is_floating_point_v<T>) return std::numeric_limits<T>::infinity();
    return std::numeric_limits<T>::max();
  }
  static constexpr T lowest() {
    if constexpr (std::is_floating_point_v<T>) return -std::numeric_limits<T>::infinity();
    return std::numeric_limits<T>::min();
  }

  bool any() const { return min <= max; }
  Extremes<T> extremes() const {
    T none{};
    if constexpr (std::is_floating_point_v<T>) none = std::numeric_limits<T>::quiet_NaN();
    return {any() ? min : none, any() ? max : none};
  }
  void add(const Extremes<T>& other) { add(other.min, other.max); }
  void add(T low, T high) {
    min = low < min ? low : min;
    max = high > max ? high : max;
  }

  void scan(const T* values, std::size_t count) {
    const T* const end = values + count;
#ifdef __SSE2__
    // The compiler may not do several values at a time by itself, because of NaN.
    if constexpr (std::is_same_v<T, float>) {
      scanLanes<__m128>(
          values, count, [](const float* v) { return _mm_loadu_ps(v); },
          [](__m128 a, __m128 b) { return _mm_min_ps(a, b); },
          [](__m128 a, __m128 b) { return _mm_max_ps(a, b); });
    } else if constexpr (std::is_same_v<T, double>) {
      scanLanes<__m128d>(
          values, count, [](const double* v) { return _mm_loadu_pd(v); },
          [](__m128d a, __m128d b) { return _mm_min_pd(a, b); },
          [](__m128d a, __m128d b) { return _mm_max_pd(a, b); });
    }
#endif
    for (; values != end; ++values) add(*values, *values);
  }

 private:
  /// Leaves `values` at what is less than a register.
  template <class Lanes>
  void scanLanes(const T*& values, std::size_t count, const auto& load, const auto& least,
                 const auto& greatest) {
    constexpr std::size_t width = sizeof(Lanes) / sizeof(T);
    if (count < 2 * width) return;
    Lanes lows, highs;
    {
      const std::array<T, width> l = filled<width>(min), h = filled<width>(max);
      std::memcpy(&lows, l.data(), sizeof lows);
      std::memcpy(&highs, h.data(), sizeof highs);
    }
    for (; count >= width; count -= width, values += width) {
      const Lanes next = load(values);
      lows = least(next, lows);  // gives the second where one is NaN
      highs = greatest(next, highs);
    }
    std::array<T, width> l, h;
    std::memcpy(l.data(), &lows, sizeof lows);
    std::memcpy(h.data(), &highs, sizeof highs);
    for (std::size_t i = 0; i < width; ++i) add(l[i], h[i]);
  }
  template <std::size_t width>
  static std::array<T, width> filled(T value) {
    std::array<T, width> all;
    all.fill(value);
    return all;
  }
};

class Column {
 public:
  /// From the 64 values of one block.
  template <class T>
  static Column ofBlock(const T* values) {
    Column out;
    const auto first = bitsOf(values[0]);
    bool same = true;
    for (std::uint32_t i = 1; i < blockRows; ++i) same = same && bitsOf(values[i]) == first;
    if (same) {
      std::memcpy(&out.m_constant, &first, sizeof first);
      return out;
    }
    out.allocate<T>(1, 1);
    out.m_raw = 1;
    T* raw = out.array<T>() + 2;
    std::copy_n(values, blockRows, raw);
    MinMax<T> all;
    for (std::uint32_t sub = 0; sub < blockRows / subRows; ++sub) {
      MinMax<T> part;
      part.scan(values + sub * subRows, subRows);
      if constexpr (hasSubs<T>) {
        reinterpret_cast<Extremes<T>*>(raw + blockRows)[sub] = part.extremes();
      }
      all.add(part.min, part.max);
    }
    out.setSummary<T>(0, all);
    return out;
  }

  /// Joins 64 columns of one block each.
  template <class T>
  static Column join(std::span<const Column* const> blocks) {
    Column out;
    std::uint64_t raw = 0;
    bool same = true;
    const auto first = bitsOf(blocks[0]->at<T>(0, 1));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (blocks[b]->m_bytes) raw |= std::uint64_t{1} << b;
      same = same && !blocks[b]->m_bytes && bitsOf(blocks[b]->constant<T>()) == first;
    }
    if (same) {
      std::memcpy(&out.m_constant, &first, sizeof first);
      return out;
    }
    out.m_raw = raw;
    out.allocate<T>(chunkBlocks, static_cast<std::uint32_t>(std::popcount(raw)));
    T* values = out.array<T>() + 2 * std::size_t{summaries(chunkBlocks)};
    MinMax<T> all, super;
    for (std::uint32_t b = 0; b < chunkBlocks; ++b) {
      MinMax<T> range;
      if (blocks[b]->m_bytes) {
        range.add(blocks[b]->summary<T>(0).min, blocks[b]->summary<T>(0).max);
        values = std::copy_n(blocks[b]->array<T>() + 2, rawValues<T>, values);
        out.setSummary<T>(ofBlocks(chunkBlocks) + b, range);
      } else {
        const T value = blocks[b]->constant<T>();
        range.add(value, value);
        out.array<Extremes<T>>()[ofBlocks(chunkBlocks) + b] = {
            value, value};  // its bits, also where it is NaN
      }
      super.add(range.min, range.max);
      if ((b + 1) % superBlocks == 0) {
        out.setSummary<T>(1 + b / superBlocks, super);
        all.add(super.min, super.max);
        super = {};
      }
    }
    out.setSummary<T>(0, all);
    return out;
  }

  template <class T>
  static Column ofConstant(T value) {
    Column out;
    std::memcpy(&out.m_constant, &value, sizeof value);
    return out;
  }

  /// The same values once more. `blocks`: of the chunk.
  template <class T>
  Column copy(std::uint32_t blocks) const {
    Column out;
    out.m_raw = m_raw;
    out.m_constant = m_constant;
    if (!m_bytes) return out;
    const std::size_t bytes = heapBytes<T>(blocks);
    out.m_bytes = std::make_unique_for_overwrite<std::byte[]>(bytes);
    std::memcpy(out.m_bytes.get(), m_bytes.get(), bytes);
    return out;
  }

  /// The same values as doubles. `blocks`: of the chunk.
  template <class T>
  Column numbers(std::uint32_t blocks) const {
    if (!m_bytes) return ofConstant(static_cast<double>(constant<T>()));
    std::array<Column, chunkBlocks> parts;
    std::array<const Column*, chunkBlocks> all{};
    for (std::uint32_t block = 0; block < blocks; ++block) {
      std::array<double, blockRows> values;
      for (std::uint32_t row = 0; row < blockRows; ++row) {
        values[row] = static_cast<double>(at<T>(block * blockRows + row, blocks));
      }
      parts[block] = ofBlock(values.data());
      all[block] = &parts[block];
    }
    return blocks == 1 ? std::move(parts[0]) : join<double>(all);
  }

  bool isConstant() const { return !m_bytes; }
  bool isRaw(std::uint32_t block) const { return (m_raw >> block & 1) != 0; }

  template <class T>
  T constant() const {
    T value;
    std::memcpy(&value, &m_constant, sizeof value);
    return value;
  }

  /// `blocks`: of the chunk, 1 or 64.
  template <class T>
  T at(std::uint32_t row, std::uint32_t blocks) const {
    if (!m_bytes) return constant<T>();
    const std::uint32_t block = row / blockRows;
    return isRaw(block) ? raw<T>(block, blocks)[row % blockRows]
                        : summary<T>(ofBlocks(blocks) + block).min;
  }

  template <class T>
  const T* raw(std::uint32_t block, std::uint32_t blocks) const {
    const std::uint64_t before = m_raw & ((std::uint64_t{1} << block) - 1);
    return array<T>() + 2 * std::size_t{summaries(blocks)} +
           static_cast<std::size_t>(std::popcount(before)) * rawValues<T>;
  }

  /// Minimum and maximum of the rows [begin, end).
  template <class T>
  void range(std::uint32_t begin, std::uint32_t end, std::uint32_t blocks, MinMax<T>& out) const {
    if (begin >= end) return;
    if (!m_bytes) return out.add(constant<T>(), constant<T>());
    const std::uint32_t last = (end - 1) / blockRows;
    std::uint32_t from = begin / blockRows, to = end / blockRows;  // whole blocks
    if (begin % blockRows != 0) {
      rangeOfBlock(from, begin % blockRows, from == last ? end - last * blockRows : blockRows,
                   blocks, out);
      if (from == last) return;
      ++from;
    }
    if (to == last) rangeOfBlock(last, 0, end - last * blockRows, blocks, out);
    const Extremes<T>* kept = array<Extremes<T>>();
    if (to - from == chunkBlocks) return out.add(kept[0]);
    const auto add = [&out](const Extremes<T>* at, std::uint32_t count) {
      for (; count > 0; --count) out.add(*at++);
    };
    const Extremes<T>* ofBlock = kept + ofBlocks(blocks);
    const std::uint32_t superFrom = (from + superBlocks - 1) / superBlocks,
                        superTo = to / superBlocks;
    if (superFrom >= superTo) return add(ofBlock + from, to - from);
    add(ofBlock + from, superFrom * superBlocks - from);
    add(kept + 1 + superFrom, superTo - superFrom);
    add(ofBlock + superTo * superBlocks, to - superTo * superBlocks);
  }

  /// Prefetch what a bucket needs that covers the chunk, and around a row where one ends.
  void want() const {
    if (!m_bytes) return;
    __builtin_prefetch(m_bytes.get());
    __builtin_prefetch(m_bytes.get() + 64);
  }
  template <class T>
  void want(std::uint32_t row, std::uint32_t blocks) const {
    if (!m_bytes) return;
    const std::uint32_t block = row / blockRows;
    __builtin_prefetch(array<Extremes<T>>() + ofBlocks(blocks) + block);
    if (!isRaw(block)) return;
    const T* values = raw<T>(block, blocks);
    constexpr std::uint32_t read = hasSubs<T> ? subRows : blockRows;
    if (hasSubs<T>) __builtin_prefetch(values + blockRows);
    const T* part = values + row % blockRows / read * read;
    for (std::uint32_t i = 0; i < read; i += 64 / sizeof(T)) __builtin_prefetch(part + i);
    __builtin_prefetch(part + read - 1);  // the memory may not begin with a cache line
  }

  template <class T>
  std::size_t heapBytes(std::uint32_t blocks) const {
    if (!m_bytes) return 0;
    return sizeof(T) * (2 * std::size_t{summaries(blocks)} +
                        static_cast<std::size_t>(std::popcount(m_raw)) * rawValues<T>);
  }

 private:
  /// Eight-byte values have minimum and maximum of each 16 rows too: to read 64 of them at every
  /// border of a bucket takes longer. For four-byte values that gains nothing and costs memory.
  template <class T>
  static constexpr bool hasSubs = sizeof(T) == 8;
  /// A raw block: its values, then minimum and maximum of each 16 of them where they are kept.
  template <class T>
  static constexpr std::uint32_t rawValues = blockRows +
                                             (hasSubs<T> ? 2 * (blockRows / subRows) : 0);

  /// Of the rows [begin, end) of one block, not all of it.
  template <class T>
  void rangeOfBlock(std::uint32_t block, std::uint32_t begin, std::uint32_t end,
                    std::uint32_t blocks, MinMax<T>& out) const {
    if (!isRaw(block)) return out.add(summary<T>(ofBlocks(blocks) + block));
    const T* values = raw<T>(block, blocks);
    if constexpr (hasSubs<T>) {
      const auto* subs = reinterpret_cast<const Extremes<T>*>(values + blockRows);
      while (begin < end) {
        const std::uint32_t stop = std::min(end, (begin / subRows + 1) * subRows);
        if (stop - begin == subRows)
          out.add(subs[begin / subRows]);
        else
          out.scan(values + begin, stop - begin);
        begin = stop;
      }
    } else {
      out.scan(values + begin, end - begin);
    }
  }

  /// Of the whole chunk, of each 8 blocks, of each block; a single block has its own only. The raw
  /// blocks follow.
  static constexpr std::uint32_t ofBlocks(std::uint32_t blocks) {
    return blocks == 1 ? 0 : 1 + blocks / superBlocks;
  }
  static constexpr std::uint32_t summaries(std::uint32_t blocks) {
    return ofBlocks(blocks) + blocks;
  }
  template <class T>
  void allocate(std::uint32_t blocks, std::uint32_t rawBlocks) {
    m_bytes = std::make_unique_for_overwrite<std::byte[]>(
        sizeof(T) * (2 * std::size_t{summaries(blocks)} + std::size_t{rawBlocks} * rawValues<T>));
  }
  template <class T>
  void setSummary(std::uint32_t at, const MinMax<T>& range) {
    array<Extremes<T>>()[at] = range.extremes();
  }
  template <class T>
  T* array() const {
    return reinterpret_cast<T*>(m_bytes.get());
  }
  template <class T>
  const Extremes<T>& summary(std::uint32_t at) const {
    return array<Extremes<T>>()[at];
  }

  std::uint64_t m_raw = 0;       // bit b: block b is kept raw
  std::uint64_t m_constant = 0;  // bits of the value, without m_bytes
  std::unique_ptr<std::byte[]> m_bytes;
};

}  // namespace pitchboard::telemetry::series
