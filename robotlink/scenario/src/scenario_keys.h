// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The numeric keys of a scenario file: name, member, range and unit in ONE table per group, read by
// the reader and the writer (docs/SCENARIOS.md explains them; a test compares). Angles are degrees
// in files and radians in memory. Private to robotlink.

#include <array>
#include <span>
#include <string_view>

#include <base/lined_json.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::link {

constexpr std::string_view inMetres = "metres";
constexpr std::string_view inDegrees = "degrees";

template <class T>
struct NumberKey {
  std::string_view key;
  double T::*member;
  NumberRange range;  ///< in the unit of the file

  bool angle() const { return range.unit.starts_with(inDegrees); }
};

std::span<const NumberKey<sim::NoiseParameters>> noiseKeys();
std::span<const NumberKey<sim::FieldSpec>> fieldKeys();
std::span<const NumberKey<sim::RigidBodySettings>> rigidBodyKeys();

/// Names of the values of sim::AfterGoal, in its order.
inline constexpr std::array<std::string_view, 2> afterGoalNames{"stop_clock", "centre_ball"};

/// Of the form of scenario files; the only one so far.
constexpr int scenarioVersion = 1;

/// Degrees that radiansFromDegrees() turns into exactly `radians` where such a double exists (the
/// shortest to write), else the nearest.
double fileDegrees(double radians);

/// Reads the keys of `noiseKeys()` over `noise`.
void readNoiseKeys(const JsonObject& object, sim::NoiseParameters& noise);

}  // namespace pitchboard::link
