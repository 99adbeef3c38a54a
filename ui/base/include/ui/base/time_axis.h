// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Time along a line of pixels, and how moments are written. Seconds of the source; pixels of a
// widget. Plain values.

#include <QDateTime>
#include <QString>
#include <optional>
#include <vector>

#include <telemetry/series/series_types.h>

namespace pitchboard::ui {

struct TimeAxis {
  telemetry::TimeRange shown{0.0, 60.0};
  double left = 0.0;   ///< pixel of shown.begin
  double width = 1.0;  ///< pixels to shown.end

  double right() const { return left + width; }
  double pixel(double time) const {
    return left + (time - shown.begin) / (shown.end - shown.begin) * width;
  }
  double time(double pixel) const {
    return shown.begin + (pixel - left) / width * (shown.end - shown.begin);
  }
  double secondsPerPixel() const { return (shown.end - shown.begin) / width; }
  bool operator==(const TimeAxis&) const = default;
};

struct AxisTick {
  double time = 0.0;
  QString label;
};

/// Round times inside the shown range, at least `minimumPixels` apart, at most 200. With `clock`
/// (the time of day at second 0) labels are times of day.
std::vector<AxisTick> axisTicks(const TimeAxis& axis, double minimumPixels,
                                const std::optional<QDateTime>& clock = {});

/// A round step of time that is at least this long: 1, 2, 5, 10, 15, 30 s, 1, 2, 5, ... min, h.
double roundStep(double seconds);

/// "03:12.250", "1:03:12", "−00:05": with this many decimals, cut off and not rounded up.
QString momentText(double seconds, int decimals);
/// The same as time of day where there is a clock (the time of day at second 0): "15:03:12.250".
QString momentText(double seconds, int decimals, const std::optional<QDateTime>& clock);
/// "00:03:12", hours always there: for a sign that does not change its width.
QString longMomentText(double seconds);

}  // namespace pitchboard::ui
