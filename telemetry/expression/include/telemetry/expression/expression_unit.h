// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The unit of a computed value, derived from the units of what it is computed from. Units are texts
// such as "cm", "m/s" or "°·s". A unit that cannot be derived is unknown, never guessed. Pure
// functions; any thread.

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace pitchboard::telemetry {

/// Returns the unit of the variable `GROUP/NAME`, or `NAME` if it is written without a group: "1"
/// for a number without a unit, such as a code; nothing if it is unknown.
using UnitOfVariable = std::function<std::optional<std::string>(const std::string& name)>;

/// Returns the unit of the value of an expression (see Expression); "1" for a number without a
/// unit; nothing if it is unknown: values of different units are added, a function is not known, or
/// a factor such as 100 converts to nothing that is known. A factor that converts a unit gives the
/// other one: cm / 100 is m.
std::optional<std::string> unitOfExpression(std::string_view text, const UnitOfVariable& unitOf);

/// Returns the unit of a value of `unit` times seconds to the power of `power`: for 1, an integral
/// over time; for -1, a derivative. An empty unit is unknown, and so is the result's.
std::string timesSeconds(std::string_view unit, int power);

}  // namespace pitchboard::telemetry
