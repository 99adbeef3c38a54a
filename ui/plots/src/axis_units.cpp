// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis_units.h"

#include <algorithm>

#include <base/units.h>

namespace pitchboard::ui {
namespace {

using Side = CurveSpec::Side;

std::optional<double> factorTo(const QString& axis, const QString& unit) {
  if (unit == axis) return 1.0;
  const auto factor = unitFactor(unit.toStdString(), axis.toStdString());
  const auto perSecond = QStringLiteral("/s");
  if (factor || !unit.endsWith(perSecond) || !axis.endsWith(perSecond)) return factor;
  return factorTo(axis.chopped(perSecond.size()), unit.chopped(perSecond.size()));
}

}  // namespace

bool AxisPlan::hasRight() const {
  return std::ranges::any_of(places, &Place::right);
}

AxisPlan planAxes(std::span<const AxisRequest> curves) {
  AxisPlan plan;
  // What was said by hand has its axis before others look for one.
  for (const AxisRequest& curve : curves) {
    if (curve.side == Side::Right && plan.right.isEmpty()) plan.right = curve.unit;
    if (curve.side != Side::Right && plan.left.isEmpty()) plan.left = curve.unit;
  }
  const bool rightIsTaken =
      std::ranges::find(curves, Side::Right, &AxisRequest::side) != curves.end();
  bool hasRight = false;
  for (const AxisRequest& curve : curves) {
    AxisPlan::Place place{.right = curve.side == Side::Right};
    if (curve.isWaiting) {
      plan.places.push_back(place);
      continue;
    }
    if (curve.side == Side::ByUnit && !factorTo(plan.left, curve.unit)) {
      place.right = true;
      // The first one has the right axis, also without a unit.
      if (!rightIsTaken && !hasRight) plan.right = curve.unit;
      hasRight = true;
    }
    const auto factor = factorTo(place.right ? plan.right : plan.left, curve.unit);
    place.factor = factor.value_or(1.0);
    place.otherUnit = !factor;
    plan.places.push_back(place);
  }
  return plan;
}

}  // namespace pitchboard::ui
