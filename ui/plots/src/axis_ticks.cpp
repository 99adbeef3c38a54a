// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/plots/axis_ticks.h>

#include <algorithm>
#include <cmath>

#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {
constexpr int maxDecimals = 12;
}

double niceStep(double span, int most) {
  if (!(span > 0.0) || !std::isfinite(span) || most < 1) return 1.0;
  const double raw = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    // The tolerance keeps 0.1 + 0.2 from needing the next step.
    if (raw <= factor * power * (1.0 + 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

double labelStep(const ValueLimits& limits, int most) {
  const double span = limits.high - limits.low;
  double step = niceStep(span, most);
  if (!(span > 0.0) || !std::isfinite(span)) return step;
  const auto multiples = [&limits](double of) {
    return std::floor(limits.high / of + 1e-9) - std::ceil(limits.low / of - 1e-9) + 1.0;
  };
  // With five steps a span has two multiples wherever it begins.
  for (int more = std::max(most, 1); multiples(step) < 2.0 && more <= most + 5; ++more) {
    step = niceStep(span, more);
  }
  return step;
}

NiceLimits niceLimits(double low, double high, int maxSteps, double headroom) {
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
    return {{0.0, 1.0}, niceStep(1.0, maxSteps)};
  }
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= size * 1e-9) {
    const double room = size > 0.0 ? size * 0.1 : 1.0;
    low -= room;
    high += room;
  }
  const double step = niceStep(high - low, maxSteps);
  NiceLimits nice{{std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step},
                  step};
  const double room = headroom * (nice.limits.high - nice.limits.low);
  const bool below = low - nice.limits.low < room, above = nice.limits.high - high < room;
  if (below) nice.limits.low -= room;
  if (above) nice.limits.high += room;
  return nice;
}

int decimalsOf(double step) {
  if (!(step > 0.0)) return 0;
  int decimals = 0;
  double scaledStep = step;
  while (decimals < maxDecimals && std::abs(scaledStep - std::round(scaledStep)) > 1e-6) {
    scaledStep *= 10.0;
    ++decimals;
  }
  return decimals;
}

QString valueText(double value) {
  if (std::isnan(value)) return QStringLiteral("–");
  if (std::isinf(value)) return value > 0 ? QStringLiteral("∞") : QStringLiteral("\u2212∞");
  const double size = std::abs(value);
  if (size != 0.0 && (size >= 1e7 || size < 1e-4)) {
    return QString::number(value, 'e', 3).replace(QLatin1Char('-'), QStringLiteral("\u2212"));
  }
  const int decimals = size >= 100.0 ? 1 : size >= 10.0 ? 2 : size >= 0.1 || size == 0.0 ? 3 : 5;
  return numberText(value, decimals);
}

}  // namespace pitchboard::ui
