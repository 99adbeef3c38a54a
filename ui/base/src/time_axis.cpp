// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/time_axis.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pitchboard::ui {
namespace {

constexpr std::array steps{0.001, 0.002, 0.005,  0.01,   0.02,   0.05,    0.1,     0.2,    0.5,
                           1.0,   2.0,   5.0,    10.0,   15.0,   30.0,    60.0,    120.0,  300.0,
                           600.0, 900.0, 1800.0, 3600.0, 7200.0, 21600.0, 43200.0, 86400.0};
constexpr std::size_t maxTicks = 200;

int decimalsOf(double step) {
  return step >= 1.0 ? 0 : step >= 0.1 ? 1 : step >= 0.01 ? 2 : 3;
}

}  // namespace

double roundStep(double seconds) {
  const auto found = std::lower_bound(steps.begin(), steps.end(), seconds);
  if (found != steps.end()) return *found;
  return std::ceil(seconds / steps.back()) * steps.back();
}

QString momentText(double seconds, int decimals) {
  if (!std::isfinite(seconds)) return QStringLiteral("–");
  double scale = 1.0;
  for (int i = 0; i < decimals; ++i) scale *= 10.0;
  // The nudge keeps 0.3, which is a little less as a double, from being written 0.299.
  const auto units = static_cast<long long>(std::floor(std::abs(seconds) * scale + 1e-6));
  const auto whole = units / static_cast<long long>(scale);
  const QLatin1Char zero('0');
  QString text =
      QStringLiteral("%1:%2").arg(whole / 60 % 60, 2, 10, zero).arg(whole % 60, 2, 10, zero);
  if (whole >= 3600) text.prepend(QString::number(whole / 3600) + QLatin1Char(':'));
  if (decimals > 0) {
    text += QLatin1Char('.') +
            QStringLiteral("%1").arg(units % static_cast<long long>(scale), decimals, 10, zero);
  }
  if (seconds < 0 && units > 0) text.prepend(QChar(0x2212));
  return text;
}

QString momentText(double seconds, int decimals, const std::optional<QDateTime>& clock) {
  if (!clock || !std::isfinite(seconds)) return momentText(seconds, decimals);
  const auto whole = static_cast<qint64>(std::floor(seconds * 1000.0 + 1e-3));
  const QString text = clock->addMSecs(whole).toString(QStringLiteral("HH:mm:ss.zzz"));
  return text.chopped(decimals <= 0 ? 4 : std::max(0, 3 - decimals));
}

QString longMomentText(double seconds) {
  const QString text = momentText(seconds, 0);
  return text.count(QLatin1Char(':')) == 1     ? QStringLiteral("00:") + text
         : text.indexOf(QLatin1Char(':')) == 1 ? QLatin1Char('0') + text
                                               : text;
}

std::vector<AxisTick> axisTicks(const TimeAxis& axis, double minimumPixels,
                                const std::optional<QDateTime>& clock) {
  std::vector<AxisTick> ticks;
  const double span = axis.shown.end - axis.shown.begin;
  if (!(span > 0) || !(axis.width > 0) || !std::isfinite(span)) return ticks;
  const double step = roundStep(
      std::max(axis.secondsPerPixel() * minimumPixels, span / static_cast<double>(maxTicks)));
  const int decimals = decimalsOf(step);
  // Times of day are round where the clock is, not where the recording began.
  double shift = 0.0;
  if (clock)
    shift = std::fmod(static_cast<double>(clock->time().msecsSinceStartOfDay()) / 1000.0, step);
  const double first = std::ceil((axis.shown.begin + shift) / step - 1e-9);
  for (std::size_t i = 0; i < maxTicks; ++i) {
    const double time = (first + static_cast<double>(i)) * step - shift;
    if (time > axis.shown.end + step * 1e-6) break;
    QString label = momentText(std::abs(time) < step * 1e-6 ? 0.0 : time, decimals);
    if (clock) {
      const QDateTime at = clock->addMSecs(std::llround(time * 1000.0));
      label = at.toString(step >= 60.0    ? QStringLiteral("HH:mm")
                          : decimals == 0 ? QStringLiteral("HH:mm:ss")
                                          : QStringLiteral("HH:mm:ss.zzz"));
    }
    ticks.push_back({time, label});
  }
  return ticks;
}

}  // namespace pitchboard::ui
