// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How full a battery is, and when that is little: the one rule for robots that are simulated, heard
// and recorded. Volts. Plain values; any thread.

namespace pitchboard::telemetry {

/// When a battery is low. Volts of one cell (lithium polymer).
struct BatteryLimits {
  int cells = 0;  ///< cells in series; 0: the least that explain the highest voltage seen
  double fullPerCell = 4.2;
  double lowPerCell = 3.5;
  double emptyPerCell = 3.3;
};

/// Of the five cells of the robots here: low below 16.0 V, empty at 14.65 V, full at 19.15 V.
inline constexpr BatteryLimits usualBattery{5, 3.83, 3.20, 2.93};

struct Battery {
  double volts = 0.0;  ///< 0: the robot says only how full it is
  int cells = 0;
  double fraction = 0.0;  ///< 0 empty, 1 full; linear in the voltage, if known
  bool low = false;
  bool operator==(const Battery&) const = default;
};

/// `highest`: the most volts that were ever seen of it, for limits that do not know the cells.
Battery batteryAt(double volts, const BatteryLimits& limits, double highest = 0.0);

}  // namespace pitchboard::telemetry
