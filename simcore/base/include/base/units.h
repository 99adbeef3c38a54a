// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The units of messages, columns and curves, and conversions between units of one kind. Constant
// data and pure functions; any thread.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <base/angles.h>

namespace pitchboard {

enum class UnitKind : std::uint8_t { None, Length, Angle, AngularRate, Voltage, Time, Share };

struct Unit {
  std::string_view name;
  UnitKind kind;
  double factor;  ///< factor to m, rad, rad/s, V, s, 1
};

inline constexpr std::array<Unit, 19> units{
    {{"m", UnitKind::Length, 1.0},
     {"cm", UnitKind::Length, 0.01},
     {"mm", UnitKind::Length, 0.001},
     {"rad", UnitKind::Angle, 1.0},
     {"°", UnitKind::Angle, radiansFromDegrees(1.0)},
     {"deg", UnitKind::Angle, radiansFromDegrees(1.0)},
     {"rad/s", UnitKind::AngularRate, 1.0},
     {"°/s", UnitKind::AngularRate, radiansFromDegrees(1.0)},
     {"V", UnitKind::Voltage, 1.0},
     {"0.1 V", UnitKind::Voltage, 0.1},
     {"dV", UnitKind::Voltage, 0.1},
     {"mV", UnitKind::Voltage, 0.001},
     {"s", UnitKind::Time, 1.0},
     {"ms", UnitKind::Time, 0.001},
     {"µs", UnitKind::Time, 1e-6},
     {"us", UnitKind::Time, 1e-6},
     {"ns", UnitKind::Time, 1e-9},
     {"%", UnitKind::Share, 0.01},
     {"1", UnitKind::Share, 1.0}}};

/// Returns the unit of this name, or null.
constexpr const Unit* unitNamed(std::string_view name) {
  const auto found = std::ranges::find(units, name, &Unit::name);
  return found == units.end() ? nullptr : &*found;
}

/// Returns the factor between two units; nothing if one is unknown or they are of different kinds.
constexpr std::optional<double> unitFactor(std::string_view from, std::string_view to) {
  const Unit *a = unitNamed(from), *b = unitNamed(to);
  if (a == nullptr || b == nullptr || a->kind != b->kind) return std::nullopt;
  return a->factor / b->factor;
}

}  // namespace pitchboard
