// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Computes how full a battery is and whether it is low, for simulated, live and recorded robots.
// The limits come from the robot's model or from the settings of Live. Values are volts. Plain
// values; any thread.

namespace pitchboard::telemetry {

/// Limits of a battery, in volts per cell (lithium polymer).
struct BatteryLimits {
  int cells = 0;  ///< cells in series; 0: as few as explain the highest voltage seen
  double fullPerCell = 4.2;
  double lowPerCell = 3.5;
  double emptyPerCell = 3.3;
  bool operator==(const BatteryLimits&) const = default;
};

/// The limits of the published robot's battery of five cells, also the default of Live: low below
/// 16.0 V, empty at 14.65 V, full at 19.15 V.
inline constexpr BatteryLimits defaultBattery{5, 3.83, 3.20, 2.93};

struct Battery {
  double volts = 0.0;  ///< 0 if the robot sends only how full it is
  int cells = 0;
  double fraction = 0.0;  ///< 0 is empty, 1 full; linear in the voltage, if that is known
  bool low = false;
  bool operator==(const Battery&) const = default;
};

/// Returns the state of a battery. `highest` is the highest voltage ever seen of it, which tells
/// how many cells it has if the limits do not.
Battery batteryAt(double volts, const BatteryLimits& limits, double highest = 0.0);

}  // namespace pitchboard::telemetry
