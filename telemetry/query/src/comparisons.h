// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The comparisons of a condition that must all hold: what a summary can rule out, and what is worst
// of it. Private to the library; pure functions. The condition is one that Expression accepts.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pitchboard::telemetry {

/// `left < right` and the like, as it stands in a condition.
struct Comparison {
  std::string left, op, right;  ///< op: "<", "<=", ">", ">=", "=="
};

/// Returns the parts of `a && b && c`; the whole text if it is of another form.
std::vector<std::string> conjunctsOf(std::string_view condition);
/// Reads a part that is one comparison; nothing if it is something else.
std::optional<Comparison> comparisonOf(std::string_view text);

/// Returns the number that a side of a comparison is; nothing if it is something else.
std::optional<double> numberIn(std::string_view text);
/// Returns `5 < X` as `X > 5`; nothing if there is no number on the left alone.
std::optional<Comparison> withNumberOnTheRight(const Comparison& comparison);

/// A comparison of a variable with a number, the variable on the left.
struct Limit {
  std::string variable;  ///< as Expression::variables() names it
  std::string op;
  double value = 0.0;
};
/// Returns the comparisons of variables with numbers that must hold where the condition holds.
std::vector<Limit> limitsOf(std::string_view condition);

}  // namespace pitchboard::telemetry
