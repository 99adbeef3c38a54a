// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Quantile of the normal law: Wichura, algorithm AS 241 (PPND16), Applied Statistics 37 (1988);
// relative error about 1e-16. In two parts, so that the middle can be computed for many at once.
// `q` is the probability minus 0.5. Pure functions.

#include <array>
#include <cmath>

#include <base/repeatable_math.h>

namespace pitchboard::quantile {

using Coefficients = std::array<double, 8>;  // from the constant one upwards

inline double polynomial(const Coefficients& c, double x) {
  return ((((((c[7] * x + c[6]) * x + c[5]) * x + c[4]) * x + c[3]) * x + c[2]) * x + c[1]) * x +
         c[0];
}

/// Whether it lies in the middle, as five in six do, which needs no logarithm.
inline bool isMiddle(double q) {
  return std::abs(q) <= 0.425;
}

inline double middle(double q) {
  constexpr Coefficients a{3.3871328727963666080,   1.3314166789178437745e2,
                           1.9715909503065514427e3, 1.3731693765509461125e4,
                           4.5921953931549871457e4, 6.7265770927008700853e4,
                           3.3430575583588128105e4, 2.5090809287301226727e3};
  constexpr Coefficients b{1.0,
                           4.2313330701600911252e1,
                           6.8718700749205790830e2,
                           5.3941960214247511077e3,
                           2.1213794301586595867e4,
                           3.9307895800092710610e4,
                           2.8729085735721942674e4,
                           5.2264952788528545610e3};
  const double r = 0.180625 - q * q;
  return q * polynomial(a, r) / polynomial(b, r);
}

/// `p`: the probability itself, inside (0, 1).
inline double away(double p, double q) {
  constexpr Coefficients c{1.42343711074968357734,    4.63033784615654529590,
                           5.76949722146069140550,    3.64784832476320460504,
                           1.27045825245236838258,    2.41780725177450611770e-1,
                           2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr Coefficients d{1.0,
                           2.05319162663775882187,
                           1.67638483018380384940,
                           6.89767334985100004550e-1,
                           1.48103976427480074590e-1,
                           1.51986665636164571966e-2,
                           5.47593808499534494600e-4,
                           1.05075007164441684324e-9};
  constexpr Coefficients e{6.65790464350110377720,    5.46378491116411436990,
                           1.78482653991729133580,    2.96560571828504891230e-1,
                           2.65321895265761230930e-2, 1.24266094738807843860e-3,
                           2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr Coefficients f{1.0,
                           5.99832206555887937690e-1,
                           1.36929880922735805310e-1,
                           1.48753612908506148525e-2,
                           7.86869131145613259100e-4,
                           1.84631831751005468180e-5,
                           1.42151175831644588870e-7,
                           2.04426310338993978564e-15};
  const double r = std::sqrt(-repeatable::log(q < 0.0 ? p : 1.0 - p));
  const double value = r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6)
                                : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
  return std::copysign(value, q);
}

inline double normal(double p) {
  const double q = p - 0.5;
  return isMiddle(q) ? middle(q) : away(p, q);
}

}  // namespace pitchboard::quantile
