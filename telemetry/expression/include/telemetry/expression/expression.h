// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An arithmetic expression over variables, such as `hypot(B1.TRUE_X - 2, B1.TRUE_Y) * 100`. The
// package muParser reads and evaluates it: operators + - * / ^, comparisons, && || ?:, its
// functions (sin, cos, atan2, sqrt, abs, min, max, ...) and ours: !, hypot, deg, rad, wrap(angle,
// turn); pi; t is the time in s. Variables are `GROUP.NAME`, or `{GROUP/NAME}` for names with other
// characters. One object for one thread at a time.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

class Expression {
 public:
  /// Fails with a sentence that names the place.
  static Result<Expression> parse(std::string_view text);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// `GROUP/NAME` of each, in the order in which they appear first.
  const std::vector<std::string>& variables() const;
  /// Values in the order of variables(). What cannot be computed is NaN.
  double evaluate(double time, std::span<const double> values);

 private:
  struct Private;
  explicit Expression(std::unique_ptr<Private> made);
  std::unique_ptr<Private> d;
};

}  // namespace pitchboard::telemetry
