// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Limits, steps and number format of value axes; ui/base/time_axis.h has those of time axes. Pure
// functions; any thread.

#include <QString>

namespace pitchboard::ui {

struct ValueLimits {
  double low = 0.0;
  double high = 1.0;
  bool operator==(const ValueLimits&) const = default;
};

/// Returns a step of 1, 2 or 5 times a power of ten, such that `span` has at most `most` steps.
double niceStep(double span, int most);
struct NiceLimits {
  ValueLimits limits;
  double step = 1.0;
};
/// Returns limits at whole steps around [low, high]; a constant value gets room on both sides.
/// Rounding may add one step to `maxSteps`. Values closer to a limit than `headroom`, a share of
/// the range, move it that much away, so that the frame of a plot does not hide them.
NiceLimits niceLimits(double low, double high, int maxSteps, double headroom = 0.0);
/// Returns a step as niceStep(), but short enough for two of its multiples to lie within the
/// limits: one number alone says nothing about a scale.
double labelStep(const ValueLimits& limits, int most);
/// Returns the decimals needed to tell multiples of `step` apart.
int decimalsOf(double step);
/// Returns a value for a legend or table, with about five significant digits.
QString valueText(double value);

}  // namespace pitchboard::ui
