// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/monitor/battery.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::telemetry {

Battery batteryAt(double volts, const BatteryLimits& limits, double highest) {
  Battery battery;
  battery.volts = volts;
  // A cell just charged may stand a little above full.
  const double most = limits.fullPerCell * 1.02;
  battery.cells =
      limits.cells > 0
          ? limits.cells
          : std::max(1, static_cast<int>(std::ceil(std::clamp(highest, 0.0, 1000.0) / most)));
  const double perCell = volts / battery.cells;
  battery.low = perCell < limits.lowPerCell;
  constexpr double minRange = 1e-3;  // V; limits that somebody typed may be equal
  battery.fraction = std::clamp((perCell - limits.emptyPerCell) /
                                    std::max(minRange, limits.fullPerCell - limits.emptyPerCell),
                                0.0, 1.0);
  return battery;
}

}  // namespace pitchboard::telemetry
