// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Angles and lengths as the published program computes them, operation for operation
// (published-exact.md, first paragraph). Degrees unless said.

#include <cmath>
#include <numbers>

namespace pitchboard::sim::published {

inline double rad(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
inline double deg(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// a mod 360 as Python's float %: a tiny negative value gives 360.0 itself.
inline double mod360(double a) {
  // fmod is exact; the two cases before it are what nearly every frame needs, and give its bits.
  if (a >= 0.0 && a < 360.0) return a + 0.0;
  double m = std::fmod(a, 360.0);
  if (m < 0.0) m += 360.0;
  return m == 0.0 ? 0.0 : m;
}

/// The published squares are the C library's pow(x, 2), which differs from x·x in the last bit
/// about once in a thousand. The exponent is volatile so that the compiler does not make it x·x.
inline double square(double x) {
  static const volatile double two = 2.0;
  return std::pow(x, two);
}

inline double length(double a, double b) {
  return std::sqrt(square(a) + square(b));
}

/// length(a, b) < limit, by a cheap test where it is not close.
inline bool isShorter(double a, double b, double limit) {
  constexpr double margin = 1.0 + 1e-9;
  if (a * a + b * b > limit * limit * margin) return false;
  return length(a, b) < limit;
}

struct UnitVector {
  explicit UnitVector(double degrees) : x(std::cos(rad(degrees))), y(std::sin(rad(degrees))) {}
  double x, y;
};

inline double chordSquared(const UnitVector& a, const UnitVector& b) {
  return square(a.x - b.x) + square(a.y - b.y);
}

/// int(a) mod 360 with Python's sign rule.
inline int wholeMod360(double a) {
  const int m = static_cast<int>(a) % 360;
  return m < 0 ? m + 360 : m;
}

}  // namespace pitchboard::sim::published
