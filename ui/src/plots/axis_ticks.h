// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where axes are divided, and how their numbers are written.

#include <QString>

namespace pitchboard::ui {

struct ValueLimits {
  double low = 0.0;
  double high = 1.0;
  bool operator==(const ValueLimits&) const = default;
};

/// A step of 1, 2 or 5 times a power of ten so that `span` has at most `most` of them.
double niceStep(double span, int most);
/// The same for time: below a second as niceStep, then 1, 2, 5, 10, 15, 30 s, 1, 2, 5 ... min, hours.
double niceTimeStep(double seconds, int most);
/// Limits on whole steps around [low, high]; a flat line gets room on both sides.
ValueLimits niceLimits(double low, double high, int mostSteps);
/// Decimals that tell multiples of `step` apart.
int decimalsOf(double step);
/// "04:57", "04:57.5", "1:04:57"; `decimals` of a second. Minus sign for times before zero.
QString momentText(double seconds, int decimals);
/// A value for a legend or a table: about five significant digits, fixed for its magnitude.
QString valueText(double value);

}  // namespace pitchboard::ui
