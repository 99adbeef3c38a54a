// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts between time and pixels on an axis, and formats times. Seconds of the source; pixels of
// the widget. Plain values; any thread.

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

/// Returns at most 200 round times in the shown range, at least `minimumPixels` apart. With
/// `clock`, the time of day at second 0, labels are times of day.
std::vector<AxisTick> axisTicks(const TimeAxis& axis, double minimumPixels,
                                const std::optional<QDateTime>& clock = {});

/// Returns the next round step that is not shorter: 1, 2, 5, 10, 15, 30 s, 1, 2, 5, ... min, h.
double roundStep(double seconds);

/// Returns "03:12.250", "1:03:12" or "−00:05" with this many decimals, which are cut off, not
/// rounded.
QString momentText(double seconds, int decimals);
/// Returns the time of day, such as "15:03:12.250", if there is a clock (the time of day at second
/// 0); otherwise the same as above.
QString momentText(double seconds, int decimals, const std::optional<QDateTime>& clock);
/// Returns "00:03:12", always with hours, for labels of constant width.
QString longMomentText(double seconds);

}  // namespace pitchboard::ui
