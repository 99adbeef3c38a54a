// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/parameters.h>

#include "parameter_check.h"

namespace pitchboard::sim {
namespace {

template <class Values>
Result<void> check(const Values& values, std::span<const Parameter<Values>> parameters,
                   const std::string& path) {
  const BadParameter bad = firstBad(values, parameters);
  if (bad.key.empty()) return {};
  return failure(ErrorCode::InvalidArgument, "This value " + bad.text + ".", path + bad.key);
}

}  // namespace

Result<void> validate(const NoiseParameters& noise) {
  return check<NoiseParameters>(noise, noiseParameters, "noise.");
}

Result<void> validate(const RigidBodySettings& body) {
  return check<RigidBodySettings>(body, rigidBodyParameters, "rigid_body.");
}

Result<void> validate(const SimulationSettings& settings) {
  return check<SimulationSettings>(settings, {&tickRateParameter, 1}, "")
      .and_then([&] { return validate(settings.field); })
      .and_then([&] { return validate(settings.noise); })
      .and_then([&] { return validate(settings.rigidBody); });
}

}  // namespace pitchboard::sim
