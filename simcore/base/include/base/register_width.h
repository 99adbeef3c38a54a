// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Loops that are compiled once for each width of the processor's registers, and the one choice
// between them while the program runs. All widths give the same bits (no fused multiply-add), so
// the choice is about speed only. Pure functions, any thread.
//
// A file that has wide loops compiles them under PITCHBOARD_WIDE_REGISTERS, behind
// `#pragma GCC target("avx2")` for Wide and
// `#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")` for Widest.

#include <initializer_list>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PITCHBOARD_WIDE_REGISTERS
#endif

namespace pitchboard {

enum class RegisterWidth {
  Narrow,  ///< what every processor of the kind has
  Wide,    ///< 256 bits
  Widest   ///< 512 bits
};

/// This processor has them and is fast with them, and this compiler can be told to use them.
bool hasRegisters(RegisterWidth width);

/// The loops for the widest registers there are. `loopsOf` gives null for a width that has none;
/// Narrow has some.
template <class Loops>
const Loops& widestLoops(const Loops* (*loopsOf)(RegisterWidth)) {
  for (const RegisterWidth width : {RegisterWidth::Widest, RegisterWidth::Wide}) {
    if (const Loops* found = loopsOf(width)) return *found;
  }
  return *loopsOf(RegisterWidth::Narrow);
}

}  // namespace pitchboard
