// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Elementary functions that give the same bits on every computer. Those of the C library are chosen
// at run time by what the processor has (fused multiply-add), and their last bits differ. Whatever
// a simulated match depends on uses these; the `published` model keeps the C library's, which made
// its recorded truth. sqrt, floor, remainder and the like are exact everywhere and stay those of
// <cmath>. The work is done by the deterministic set of SLEEF, within 3.5 units in the last place
// (exp, pow: 1). Radians; any thread.

#include <cmath>

namespace pitchboard::repeatable {

struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Both at once, for the price of one.
SinCos sinCos(double radians);
inline double sin(double radians) {
  return sinCos(radians).sin;
}
inline double cos(double radians) {
  return sinCos(radians).cos;
}
double atan2(double y, double x);
double exp(double x);
double log(double x);
double pow(double x, double y);

/// For lengths on a field: nothing is done about squares that overflow.
inline double hypot(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace pitchboard::repeatable
