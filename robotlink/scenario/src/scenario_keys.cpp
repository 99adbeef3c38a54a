// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario_keys.h"

#include <array>
#include <charconv>
#include <cmath>

#include <base/angles.h>

namespace pitchboard::link {

double fileDegrees(double radians) {
  const double quotient = degreesFromRadians(radians);
  double best = quotient;
  // Two roundings lie between the two forms, so the right one may be a neighbour.
  for (const double candidate :
       {quotient, std::nextafter(quotient, -1e300), std::nextafter(quotient, 1e300)}) {
    if (radiansFromDegrees(candidate) == radians) {
      best = candidate;
      break;
    }
  }
  const double target = radiansFromDegrees(best);
  for (int digits = 1; digits < 17; ++digits) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), best,
                                   std::chars_format::general, digits);
    double candidate = best;
    std::from_chars(text.data(), end.ptr, candidate);
    if (radiansFromDegrees(candidate) == target) return candidate;
  }
  return best;
}

RuntimeChoice Scenario::runtimeOf(const ScenarioRobot& robot) const {
  if (robot.runtime.isChosen()) return robot.runtime;
  const auto team = runtimes.find(robot.identity.team);
  return team == runtimes.end() ? RuntimeChoice{} : team->second;
}

}  // namespace pitchboard::link
