// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers as text, fast: a cell remembers what it wrote, because most values of a row are those of
// the row before.

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>

#include <base/byte_sizes.h>

#include "export_selection.h"

namespace pitchboard::telemetry {

/// Text of one value, and the bits that it stands for.
struct Cell {
  static constexpr std::size_t room = 32;  ///< no double needs more than 24
  std::array<char, room> text{};
  std::uint32_t length = 0;
  bool filled = false;
  std::uint64_t bits = 0;

  void set(ColumnType type, std::uint64_t newBits) {
    if (filled && bits == newBits) return;
    filled = true;
    bits = newBits;
    char* const end = text.data() + room;
    std::to_chars_result done{};
    switch (type) {
      case ColumnType::Int32:
        done = std::to_chars(text.data(), end,
                             std::bit_cast<std::int32_t>(static_cast<std::uint32_t>(newBits)));
        break;
      case ColumnType::Float32:
        done = std::to_chars(text.data(), end,
                             std::bit_cast<float>(static_cast<std::uint32_t>(newBits)));
        break;
      case ColumnType::Float64:
        done = std::to_chars(text.data(), end, std::bit_cast<double>(newBits));
        break;
    }
    length = static_cast<std::uint32_t>(done.ptr - text.data());
  }
  /// Not a number or infinite: JSON cannot express them.
  bool isNumber() const {
    const char last = length > 0 ? text[length - 1] : 'n';
    return last >= '0' && last <= '9';
  }
};

inline std::uint64_t bitsOf(const SelectedColumn& column, const RowView& row) {
  return column.type == ColumnType::Float64 ? std::bit_cast<std::uint64_t>(row.values[column.index])
                                            : row.words[column.index];
}

/// A buffer that grows by pieces of known greatest length and is handed on when it is large.
class TextBuffer {
 public:
  explicit TextBuffer(const std::function<bool(std::string_view)>& sink) : m_sink(sink) {
    m_text.resize(flushAt + 4096);
  }
  /// Room for `bytes` more.
  void reserve(std::size_t bytes) {
    if (m_used + bytes > m_text.size()) m_text.resize((m_used + bytes) * 2);
  }
  /// After reserve(Cell::room): copies a fixed count of bytes, which is one instruction or two.
  void put(const Cell& cell) {
    std::memcpy(m_text.data() + m_used, cell.text.data(), Cell::room);
    m_used += cell.length;
  }
  void put(char c) { m_text[m_used++] = c; }
  void put(std::string_view text) {
    std::memcpy(m_text.data() + m_used, text.data(), text.size());
    m_used += text.size();
  }
  void putSafely(std::string_view text) {
    reserve(text.size());
    put(text);
  }
  bool endLine() {
    reserve(1);
    put('\n');
    ++m_lines;
    return m_used < flushAt || flush();
  }
  bool flush() {
    m_bytes += m_used;
    const bool taken = m_used == 0 || m_sink(std::string_view(m_text).substr(0, m_used));
    m_used = 0;
    m_failed = m_failed || !taken;
    return taken;
  }
  bool failed() const { return m_failed; }
  std::uint64_t bytes() const { return m_bytes; }
  std::uint64_t lines() const { return m_lines; }

 private:
  static constexpr std::size_t flushAt = 256 * kibibyte;
  const std::function<bool(std::string_view)>& m_sink;
  std::string m_text;
  std::size_t m_used = 0;
  std::uint64_t m_bytes = 0, m_lines = 0;
  bool m_failed = false;
};

}  // namespace pitchboard::telemetry
