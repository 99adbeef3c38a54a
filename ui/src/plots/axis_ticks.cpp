// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis_ticks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shell/robot_words.h"

namespace pitchboard::ui {
namespace {
constexpr int mostDecimals = 12;
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

double niceTimeStep(double seconds, int most) {
  static constexpr std::array<double, 17> steps{1,   2,   5,    10,   15,   30,   60,    120,  300,
                                                600, 900, 1800, 3600, 7200, 14400, 43200, 86400};
  const double raw = seconds / std::max(most, 1);
  if (raw <= 0.5) return niceStep(seconds, most);
  for (const double step : steps) {
    if (raw <= step * (1.0 + 1e-9)) return step;
  }
  return niceStep(seconds / steps.back(), most) * steps.back();
}

ValueLimits niceLimits(double low, double high, int mostSteps) {
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) return {0.0, 1.0};
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= size * 1e-9) {
    const double room = size > 0.0 ? size * 0.1 : 1.0;
    low -= room;
    high += room;
  }
  const double step = niceStep(high - low, mostSteps);
  return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step};
}

int decimalsOf(double step) {
  if (!(step > 0.0)) return 0;
  int decimals = 0;
  double scaledStep = step;
  while (decimals < mostDecimals && std::abs(scaledStep - std::round(scaledStep)) > 1e-6) {
    scaledStep *= 10.0;
    ++decimals;
  }
  return decimals;
}

QString momentText(double seconds, int decimals) {
  const double unit = std::pow(10.0, decimals);
  // Rounded first, so that 59.9996 does not become "00:60.000".
  const double whole = std::round(std::abs(seconds) * unit) / unit;
  const bool negative = seconds < 0.0 && whole > 0.0;
  const auto minutesAll = static_cast<qlonglong>(std::floor(whole / 60.0));
  const double rest = whole - 60.0 * static_cast<double>(minutesAll);
  QString text = negative ? QStringLiteral("\u2212") : QString();
  if (minutesAll >= 60) {
    text += QStringLiteral("%1:%2").arg(minutesAll / 60).arg(minutesAll % 60, 2, 10,
                                                             QLatin1Char('0'));
  } else {
    text += QStringLiteral("%1").arg(minutesAll, 2, 10, QLatin1Char('0'));
  }
  const int width = decimals > 0 ? 3 + decimals : 2;
  return text + QLatin1Char(':') +
         QStringLiteral("%1").arg(rest, width, 'f', decimals, QLatin1Char('0'));
}

QString valueText(double value) {
  if (std::isnan(value)) return QStringLiteral("–");
  if (std::isinf(value)) return value > 0 ? QStringLiteral("∞") : QStringLiteral("\u2212∞");
  const double size = std::abs(value);
  if (size != 0.0 && (size >= 1e7 || size < 1e-4)) {
    return QString::number(value, 'e', 3).replace(QLatin1Char('-'), QStringLiteral("\u2212"));
  }
  const int decimals = size >= 1000.0 ? 1 : size >= 10.0 ? 2 : size >= 0.1 || size == 0.0 ? 3 : 5;
  return numberText(value, decimals);
}

}  // namespace pitchboard::ui
