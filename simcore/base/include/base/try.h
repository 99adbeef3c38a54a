// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// TRY(result) gives the value of a Result, or returns its error from the enclosing function, which
// must return a Result itself:
//
//   const auto text = TRY(readFile(path, most));
//   TRY(check(text));
//
// Do not nest it. It uses an extension of GCC and Clang. Any thread.

#include <type_traits>
#include <utility>

#include <base/result.h>

namespace pitchboard {

template <class T>
T valueOf(Result<T>&& result) {
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace pitchboard

#define TRY(...)                                                                                \
  __extension__({                                                                               \
    auto triedResult = __VA_ARGS__;                                                             \
    if (!triedResult) return tl::unexpected<pitchboard::Error>(std::move(triedResult).error()); \
    pitchboard::valueOf(std::move(triedResult));                                                \
  })
