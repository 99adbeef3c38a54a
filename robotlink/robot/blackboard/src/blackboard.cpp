// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/blackboard/blackboard.h>

#include <array>
#include <utility>

#include "blackboard_memory.h"

namespace pitchboard::link {
namespace {

class HeapMemory : public BlackboardMemory {
 public:
  std::uint32_t* words() override { return m_words.data(); }
  int key() const override { return 0; }
  bool created() const override { return false; }

 private:
  // A cache line's alignment: two robots' heap blackboards never share a line.
  alignas(64) std::array<std::uint32_t, Blackboard::words> m_words{};
};

}  // namespace

static_assert(std::atomic_ref<std::uint32_t>::is_always_lock_free,
              "other processes see the words: a lock of this process would protect nothing");

Blackboard Blackboard::onHeap() {
  return Blackboard(std::make_unique<HeapMemory>());
}

Blackboard::Blackboard(std::unique_ptr<BlackboardMemory> memory)
    : m_memory(std::move(memory)), m_words(m_memory->words()) {}

Blackboard::Blackboard(std::span<std::uint32_t, words> memory) : m_words(memory.data()) {}

Blackboard::Blackboard(Blackboard&& other) noexcept
    : m_memory(std::move(other.m_memory)), m_words(std::exchange(other.m_words, nullptr)) {}

Blackboard& Blackboard::operator=(Blackboard&& other) noexcept {
  m_memory = std::move(other.m_memory);
  m_words = std::exchange(other.m_words, nullptr);
  return *this;
}

Blackboard::~Blackboard() = default;

void Blackboard::copyWords(std::span<std::uint32_t, words> out) const {
  for (int index = 0; index < words; ++index)
    out[static_cast<std::size_t>(index)] = word(index).load(std::memory_order_relaxed);
}

int Blackboard::key() const {
  return m_memory ? m_memory->key() : 0;
}

bool Blackboard::created() const {
  return m_memory && m_memory->created();
}

}  // namespace pitchboard::link
