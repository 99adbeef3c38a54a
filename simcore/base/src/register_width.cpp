// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/register_width.h>

namespace pitchboard {

bool hasRegisters(RegisterWidth width) {
  switch (width) {
    case RegisterWidth::Narrow:
      return true;
#ifdef PITCHBOARD_WIDE_REGISTERS
    case RegisterWidth::Wide:
      return __builtin_cpu_supports("avx2") != 0;
    case RegisterWidth::Widest:
      // Processors that lack vbmi2 have the registers, but slow down for everything when they are
      // used.
      return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vbmi2");
#else
    default:
      break;
#endif
  }
  return false;
}

}  // namespace pitchboard
