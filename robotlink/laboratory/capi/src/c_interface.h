// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all parts of the C interface share: handles, and errors as a code and a sentence. No
// exception passes to the caller. Any thread.

#include <pitchboard_sim.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <base/result.h>

namespace pitchboard::link::capi {

/// Maps handles of the C interface to objects. Thread-safe; a handle is never dereferenced. Handles
/// are numbers that are never reused, so that a destroyed one is always recognized.
template <class Object, class Handle>
class Handles {
 public:
  Handle* add(std::shared_ptr<Object> object) {
    const std::lock_guard lock(m_mutex);
    m_last += sizeof(std::max_align_t);
    m_objects.emplace(m_last, std::move(object));
    return reinterpret_cast<Handle*>(m_last);
  }
  std::shared_ptr<Object> find(const Handle* handle) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_objects.find(reinterpret_cast<std::uintptr_t>(handle));
    return found == m_objects.end() ? nullptr : found->second;
  }
  /// The object is deleted when its last user lets go of it.
  std::shared_ptr<Object> remove(const Handle* handle) {
    const std::lock_guard lock(m_mutex);
    const auto found = m_objects.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == m_objects.end()) return nullptr;
    auto object = std::move(found->second);
    m_objects.erase(found);
    return object;
  }

 private:
  std::mutex m_mutex;
  std::uintptr_t m_last = 0x1000;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Object>> m_objects;
};

/// Keeps the sentence for pb_last_error() of this thread and returns the status.
pb_status reportStatus(pb_status status, std::string_view sentence);
pb_status reportStatus(const Result<void>& result);
/// Reports that an argument is null.
pb_status missing(const char* what);

/// Calls `call`, which returns a status, and catches all exceptions.
template <class Call>
pb_status guarded(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return reportStatus(PB_SYSTEM_ERROR, "there is not enough memory; ask for less at a time");
  } catch (const std::exception& error) {
    return reportStatus(PB_SYSTEM_ERROR, error.what());
  }
}

/// Runs `use(Object&)` with what a handle stands for, alone. `what` names it: "worlds".
template <class Object, class Handle, class Use>
pb_status withHandle(Handles<Object, Handle>& handles, const Handle* handle, const char* what,
                     const Use& use) {
  if (handle == nullptr) return missing(what);
  const auto found = handles.find(handle);
  if (!found) {
    return reportStatus(PB_STALE_HANDLE, std::string("the handle of the ") + what +
                                             " is not valid: it was destroyed or never created");
  }
  const std::lock_guard lock(found->mutex);
  return use(*found);
}

/// Destroys what a handle stands for, once its last call has returned. Null is nothing.
template <class Object, class Handle>
pb_status destroyHandle(Handles<Object, Handle>& handles, const Handle* handle, const char* what) {
  return guarded([&] {
    if (handle == nullptr) return reportStatus(PB_OK, "");
    const auto removed = handles.remove(handle);
    if (!removed) {
      return reportStatus(PB_STALE_HANDLE,
                          std::string("the handle of the ") + what + " was destroyed before");
    }
    const std::lock_guard waited(removed->mutex);
    return reportStatus(PB_OK, "");
  });
}

/// Returns the caller's array; null is an empty one, whose size is then refused.
template <class Value>
std::span<Value> spanOf(Value* values, std::size_t count) {
  return values == nullptr ? std::span<Value>() : std::span<Value>(values, count);
}

inline Result<void> refusal(std::string sentence) {
  return failure(ErrorCode::InvalidArgument, std::move(sentence));
}

}  // namespace pitchboard::link::capi
