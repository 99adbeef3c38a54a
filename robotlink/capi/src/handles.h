// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the handles of the C interface stand for. Thread-safe; a handle is never looked into.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace pitchboard::link {

/// Handles are numbers that are never used twice, so that one that was destroyed is known as such
/// whatever memory holds now.
template <class Thing, class Handle>
class Handles {
 public:
  Handle* add(std::shared_ptr<Thing> thing) {
    const std::lock_guard lock(m_mutex);
    m_last += sizeof(std::max_align_t);
    m_things.emplace(m_last, std::move(thing));
    return reinterpret_cast<Handle*>(m_last);
  }
  std::shared_ptr<Thing> find(const Handle* handle) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_things.find(reinterpret_cast<std::uintptr_t>(handle));
    return found == m_things.end() ? nullptr : found->second;
  }
  /// The thing goes when nobody uses it any more.
  std::shared_ptr<Thing> remove(const Handle* handle) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_things.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == m_things.end()) return nullptr;
    auto thing = std::move(found->second);
    m_things.erase(found);
    return thing;
  }

 private:
  std::mutex m_mutex;
  std::uintptr_t m_last = 0x1000;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Thing>> m_things;
};

}  // namespace pitchboard::link
