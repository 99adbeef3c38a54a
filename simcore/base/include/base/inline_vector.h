// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A vector with room for N items inside the object, so that it never allocates memory: for short
// lists that are made in every cycle, and for values that are copied often. One thread at a time.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <initializer_list>

namespace pitchboard {

template <class T, std::size_t N>
class InlineVector {
 public:
  static constexpr std::size_t capacity = N;

  InlineVector() = default;
  InlineVector(std::initializer_list<T> items) {
    for (const T& item : items) push_back(item);
  }

  std::size_t size() const { return m_size; }
  bool empty() const { return m_size == 0; }
  bool full() const { return m_size == N; }
  T* data() { return m_items.data(); }
  const T* data() const { return m_items.data(); }
  T* begin() { return data(); }
  const T* begin() const { return data(); }
  T* end() { return data() + m_size; }
  const T* end() const { return data() + m_size; }
  T& operator[](std::size_t i) { return m_items[i]; }
  const T& operator[](std::size_t i) const { return m_items[i]; }
  T& front() { return m_items[0]; }
  const T& front() const { return m_items[0]; }
  T& back() { return m_items[m_size - 1]; }
  const T& back() const { return m_items[m_size - 1]; }

  /// Appends an item. A full vector is an error of the caller: debug builds assert, others drop the
  /// item.
  void push_back(const T& item) {
    assert(!full());
    if (!full()) m_items[m_size++] = item;
  }
  void clear() { m_size = 0; }
  /// Removes items from the end until `size` are left. Does nothing if there are fewer.
  void shrink(std::size_t size) { m_size = std::min(m_size, size); }
  void erase(const T* item) {
    std::copy(item + 1, static_cast<const T*>(end()), begin() + (item - begin()));
    --m_size;
  }

 private:
  std::array<T, N> m_items{};
  std::size_t m_size = 0;
};

}  // namespace pitchboard
