// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rerun/compared_variable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace pitchboard::link {
namespace {

/// What a robot cannot act on: a whole centimetre or degree is the resolution of most variables.
struct UnitTolerance {
  std::string_view unit;
  double tolerance;
};
constexpr std::array unitTolerances{
    UnitTolerance{"cm", 1.0},   UnitTolerance{"m", 0.01},   UnitTolerance{"°", 1.0},
    UnitTolerance{"rad", 0.02}, UnitTolerance{"m/s", 0.01}, UnitTolerance{"rad/s", 0.02},
    UnitTolerance{"g", 0.01},   UnitTolerance{"s", 0.1},    UnitTolerance{"0.1 V", 1.0},
};

std::string shortNumber(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

const std::string* labelOf(const telemetry::ColumnInfo& column, double value) {
  if (column.labels.empty() || !(std::abs(value) <= 2147483647.0)) return nullptr;
  const auto found = column.labels.find(static_cast<std::int32_t>(value));
  return found == column.labels.end() ? nullptr : &found->second;
}

std::string plainText(const telemetry::ColumnInfo& column, double value) {
  const std::string* label = labelOf(column, value);
  return label ? *label : shortNumber(value);
}

}  // namespace

double toleranceOf(const telemetry::ColumnInfo& column) {
  if (column.kind != telemetry::ColumnKind::Number) return 0.0;
  const auto found = std::ranges::find(unitTolerances, column.unit, &UnitTolerance::unit);
  return found == unitTolerances.end() ? 0.0 : found->tolerance;
}

std::string valueText(const telemetry::ColumnInfo& column, double value) {
  const bool hasUnit = !column.unit.empty() && !labelOf(column, value);
  return plainText(column, value) + (hasUnit ? ' ' + column.unit : std::string());
}

std::string differenceText(const ComparedVariable& variable, const DifferentStretch& stretch) {
  return plainText(variable.column, stretch.rerun) + " instead of " +
         valueText(variable.column, stretch.recorded);
}

}  // namespace pitchboard::link
