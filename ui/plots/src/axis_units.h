// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// At which value axis of a chart a curve is read, by its unit: the first unit has the left axis,
// and so has what can be converted to it; the next one that cannot has the right axis. A curve
// whose unit is unknown is never read at the axis of a unit. Pure.

#include <QString>
#include <span>
#include <vector>

#include <ui/plots/plot_layout.h>

namespace pitchboard::ui {

struct AxisPlan {
  struct Place {
    bool right = false;
    double factor = 1.0;     ///< number at the axis = factor × value of the curve
    bool otherUnit = false;  ///< its unit cannot be converted to that of the axis
    bool operator==(const Place&) const = default;
  };
  QString left, right;        ///< units of the axes; empty: unknown, or there is no such axis
  std::vector<Place> places;  ///< of the curves, in their order
  bool hasRight() const;
};

struct AxisRequest {
  QString unit;  ///< empty: unknown
  CurveSpec::Side side = CurveSpec::Side::ByUnit;
  bool isWaiting = false;  ///< for its variables: it needs no axis yet
};
AxisPlan planAxes(std::span<const AxisRequest> curves);

}  // namespace pitchboard::ui
