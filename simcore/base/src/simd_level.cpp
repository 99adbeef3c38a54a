// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/simd_level.h>

namespace pitchboard {

bool supports(SimdLevel level) {
  switch (level) {
    case SimdLevel::Baseline:
      return true;
#ifdef PITCHBOARD_SIMD_LEVELS
    case SimdLevel::Avx2:
      return __builtin_cpu_supports("avx2") != 0;
    case SimdLevel::Avx512:
      // Processors without vbmi2 have these registers, but using them slows everything else down.
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
