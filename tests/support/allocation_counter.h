// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counts what a whole test program allocates, so that "allocates nothing" is more than a promise.
// It replaces functions of the program: one file of a test includes it, and no library. All
// threads.
//
// With glibc malloc() itself is replaced, so that C code (Box2D) counts as well; elsewhere operator
// new. Not with sanitizers: they match every release with the function that allocated, and need
// these functions themselves.

#include <atomic>
#include <cstdlib>
#include <new>

#include "sanitized.h"

inline std::atomic<long> allocations{0};

#if PITCHBOARD_SANITIZED
inline constexpr bool countsAllocations = false;
#else
inline constexpr bool countsAllocations = true;
#if defined(__GLIBC__)
extern "C" {
void* __libc_malloc(std::size_t);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
}
#else
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif
#endif

/// True when the counter notices an allocation: what it says of none can be believed.
inline bool theCounterCounts() {
  const long before = allocations;
  int* volatile something = new int(0);
  delete something;
  return allocations > before;
}
