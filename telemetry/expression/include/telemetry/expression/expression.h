// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An arithmetic expression over variables, such as `hypot(B1.TRUE_X - 2, B1.TRUE_Y) * 100`. The
// library muParser parses and evaluates it. It knows + - * / ^, comparisons, && || ?:, the
// functions of muParser (sin, cos, atan2, sqrt, abs, min, max, ...) and ours (!, hypot, deg, rad,
// wrap(angle, turn), known), pi, and t, the time in s. Variables are written `GROUP.NAME`, or
// `{GROUP/NAME}` for names with other characters; a caller may say of which group names without one
// are. NaN is an unknown value: every operator and every
// function of one is NaN, except known() and the branch of ?: that is not taken (docs/plots.md). An
// object may be used by one thread at a time.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

class Expression {
 public:
  /// Parses an expression. A name without a group is of `group`; if that is empty, it is a mistake.
  /// Fails with ParseError and the position of the mistake.
  static Result<Expression> parse(std::string_view text, std::string_view group = {});
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// Returns the variables as `GROUP/NAME`, in the order in which they first appear.
  const std::vector<std::string>& variables() const;
  /// Computes the value at `time` (s) from `values`, which are in the order of variables(). Returns
  /// NaN if it is unknown or cannot be computed.
  double evaluate(double time, std::span<const double> values);

 private:
  struct Private;
  explicit Expression(std::unique_ptr<Private> made);
  std::unique_ptr<Private> d;
};

}  // namespace pitchboard::telemetry
