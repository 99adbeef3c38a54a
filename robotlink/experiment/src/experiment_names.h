// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the name of an experiment may be made of: it is the name of its file and folder, too. Pure.

#include <cstddef>
#include <string_view>

namespace pitchboard::link {

inline constexpr std::size_t mostNameLetters = 64;

constexpr bool isNameLetter(char c) {
  return std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.")
             .find(c) != std::string_view::npos;
}

}  // namespace pitchboard::link
