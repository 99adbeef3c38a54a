// SPDX-License-Identifier: GPL-3.0-or-later
#include <Random123/philox.h>

#include <array>
#include <cmath>

#include <base/random.h>
#include <base/repeatable_math.h>

namespace pitchboard {
namespace {

using Coefficients = std::array<double, 8>;  // from the constant one upwards

double polynomial(const Coefficients& c, double x) {
  return ((((((c[7] * x + c[6]) * x + c[5]) * x + c[4]) * x + c[3]) * x + c[2]) * x + c[1]) * x +
         c[0];
}

/// Quantile of the normal law: Wichura, algorithm AS 241 (PPND16), Applied Statistics 37 (1988);
/// relative error about 1e-16. Five draws in six need no logarithm. `p` inside (0, 1).
double normalQuantile(double p) {
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
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
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
  const double away = r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6)
                               : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
  return std::copysign(away, q);
}

}  // namespace

CounterRandom::CounterRandom(std::uint64_t seed, int robot, NoiseStream stream, std::uint64_t tick)
    : m_key{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      // The second word counts the blocks drawn in its lower half and keeps the tick's high bits in
      // its upper half, so that 2^48 ticks and 65536 blocks of one tick never meet.
      m_counter{static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32) << 16,
                static_cast<std::uint32_t>(robot), static_cast<std::uint32_t>(stream)} {}

void CounterRandom::refill() {
  const philox4x32_ctr_t counter = {{m_counter[0], m_counter[1], m_counter[2], m_counter[3]}};
  const philox4x32_key_t key = {{m_key[0], m_key[1]}};
  const philox4x32_ctr_t block = philox4x32(counter, key);
  for (int i = 0; i < 4; ++i) m_block[i] = block.v[i];
  ++m_counter[1];
  m_used = 0;
}

std::uint64_t CounterRandom::bits() {
  if (m_used > 2) refill();
  const std::uint64_t bits = (static_cast<std::uint64_t>(m_block[m_used]) << 32) |
                             static_cast<std::uint64_t>(m_block[m_used + 1]);
  m_used += 2;
  return bits >> 11;
}

double CounterRandom::uniform() {
  return static_cast<double>(bits()) * 0x1.0p-53;
}

double CounterRandom::normal(double mean, double sigma) {
  if (sigma == 0.0) return mean;
  // In the middle of its step, so that it is neither 0 nor 1.
  return mean + sigma * normalQuantile((static_cast<double>(bits()) + 0.5) * 0x1.0p-53);
}

}  // namespace pitchboard
