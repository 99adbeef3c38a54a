// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sizes in bytes: 4 * mebibyte.

#include <cstddef>

namespace pitchboard {

inline constexpr std::size_t kibibyte = 1024, mebibyte = 1024 * kibibyte;

}  // namespace pitchboard
