// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// TRY(result) is the value of a Result, or returns its error from the function around it, which
// itself returns a Result:
//
//   const auto text = TRY(readFile(path, most));
//   TRY(check(text));
//
// Not inside another TRY. Uses an extension that GCC and Clang share.

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
