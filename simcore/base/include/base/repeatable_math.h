// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Elementary functions that give the same bits on every computer. The C library chooses its
// versions by what the processor can do (fused multiply-add), and their last bits differ.
// Everything that a simulated match depends on uses the functions here; only the `published` model
// uses the C library's, because its recorded truth was made with them. sqrt, floor, remainder and
// the like are exact everywhere, so use <cmath> for them. The deterministic functions of SLEEF do
// the work, within 3.5 units in the last place (exp, pow: 1). Radians; pure functions; any thread.

#include <cmath>

namespace pitchboard::repeatable {

struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Returns sine and cosine together, for the cost of one.
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

/// Returns a length on the field; it does not protect against squares that overflow.
inline double hypot(double x, double y) {
  return std::sqrt(x * x + y * y);
}

}  // namespace pitchboard::repeatable
