// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A typed view over a robot's blackboard: 512 words of 4 bytes, int variable i at word i, float
// variable j at word 125 + j (system.md section 2). The memory is a System V segment, shared with a
// robot's processes, or heap memory for fast runs. Words are read and written atomically (relaxed):
// a reader never sees half a float, but there is no order between variables. Any thread and any
// process may use the same words at the same time.

#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

/// Index of an int variable (IntVar) or of a float variable (FloatVar). The same number can mean
/// one of each, so the type belongs to the index.
struct IntVar {
  int index = 0;
  auto operator<=>(const IntVar&) const = default;
};
struct FloatVar {
  int index = 0;
  auto operator<=>(const FloatVar&) const = default;
};

class BlackboardMemory;  // owns the words; System V or heap

class Blackboard {
 public:
  static constexpr int words = 512;
  static constexpr int bytes = words * 4;
  static constexpr int floatOffset = 125;  ///< word of float variable 0
  static constexpr int intVariables = words;
  static constexpr int floatVariables = words - floatOffset;

  /// Creates a blackboard of zeros in heap memory.
  static Blackboard onHeap();
  /// Uses words that somebody else owns, which must outlive it.
  static Blackboard over(std::span<std::uint32_t, words> memory) { return Blackboard(memory); }
  /// Another one of the same words, which this one must outlive.
  Blackboard view() const { return over(std::span<std::uint32_t, words>(m_words, words)); }

  Blackboard(Blackboard&&) noexcept;
  Blackboard& operator=(Blackboard&&) noexcept;
  ~Blackboard();

  int read(IntVar variable) const {
    return std::bit_cast<std::int32_t>(word(variable.index).load(std::memory_order_relaxed));
  }
  float read(FloatVar variable) const {
    return std::bit_cast<float>(word(floatOffset + variable.index).load(std::memory_order_relaxed));
  }
  void write(IntVar variable, int value) {
    word(variable.index).store(std::bit_cast<std::uint32_t>(value), std::memory_order_relaxed);
  }
  void write(FloatVar variable, float value) {
    word(floatOffset + variable.index)
        .store(std::bit_cast<std::uint32_t>(value), std::memory_order_relaxed);
  }
  /// Writes `value` only if the variable still is `expected`; returns whether it was.
  bool replace(IntVar variable, int expected, int value) {
    std::uint32_t old = std::bit_cast<std::uint32_t>(expected);
    return word(variable.index)
        .compare_exchange_strong(old, std::bit_cast<std::uint32_t>(value),
                                 std::memory_order_relaxed);
  }

  /// Reads all 512 words, each atomically, but not all at one instant.
  void copyWords(std::span<std::uint32_t, words> out) const;

  /// Returns the System V key, or 0 for heap memory.
  int key() const;
  /// Returns whether this object created the segment, which it then removes when destroyed.
  bool created() const;

 private:
  friend class SystemVSegments;
  explicit Blackboard(std::unique_ptr<BlackboardMemory> memory);
  explicit Blackboard(std::span<std::uint32_t, words> memory);

  std::atomic_ref<std::uint32_t> word(int index) const {
    return std::atomic_ref<std::uint32_t>(m_words[index]);
  }

  std::unique_ptr<BlackboardMemory> m_memory;
  std::uint32_t* m_words = nullptr;
};

}  // namespace pitchboard::link
