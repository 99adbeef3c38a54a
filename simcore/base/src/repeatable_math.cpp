// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/repeatable_math.h>

#include <sleef.h>

namespace pitchboard::repeatable {

// Vectors of two give the same bits as the scalar functions (tst_repeatable_math), in less time.

SinCos sinCos(double radians) {
#ifdef __SSE2__
  const Sleef___m128d_2 both = Sleef_cinz_sincosd2_u35sse2(_mm_set1_pd(radians));
  return {_mm_cvtsd_f64(both.x), _mm_cvtsd_f64(both.y)};
#else
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u35purec(radians);
  return {both.x, both.y};
#endif
}

double atan2(double y, double x) {
#ifdef __SSE2__
  return _mm_cvtsd_f64(Sleef_cinz_atan2d2_u35sse2(_mm_set1_pd(y), _mm_set1_pd(x)));
#else
  return Sleef_cinz_atan2d1_u35purec(y, x);
#endif
}
double exp(double x) {
  return Sleef_cinz_expd1_u10purec(x);
}
double log(double x) {
#ifdef __SSE2__
  return _mm_cvtsd_f64(Sleef_cinz_logd2_u35sse2(_mm_set1_pd(x)));
#else
  return Sleef_cinz_logd1_u35purec(x);
#endif
}
double pow(double x, double y) {
  return Sleef_cinz_powd1_u10purec(x, y);
}

}  // namespace pitchboard::repeatable
