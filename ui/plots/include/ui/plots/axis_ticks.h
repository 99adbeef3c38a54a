// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where value axes are divided, and how their numbers are written. (Time: timeline/time_axis.h.)

#include <QString>

namespace pitchboard::ui {

struct ValueLimits {
  double low = 0.0;
  double high = 1.0;
  bool operator==(const ValueLimits&) const = default;
};

/// A step of 1, 2 or 5 times a power of ten so that `span` has at most `most` of them.
double niceStep(double span, int most);
struct NiceLimits {
  ValueLimits limits;
  double step = 1.0;
};
/// Limits on whole steps around [low, high]; a flat line gets room on both sides. One step more
/// than `mostSteps` where the ends are rounded.
NiceLimits niceLimits(double low, double high, int mostSteps);
/// Decimals that tell multiples of `step` apart.
int decimalsOf(double step);
/// A value for a legend or a table: about five significant digits, fixed for its magnitude.
QString valueText(double value);

}  // namespace pitchboard::ui
