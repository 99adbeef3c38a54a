// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Evaluates expressions (expression.h) over the rows of a session or of memory, for one or all of
// its robots, with the meaning that plots give them: at the times of the first variable, with the
// last values of the others, and unknown where a value is unknown or its group was silent for more
// than 10 s. Only the groups that the expressions need are read, and no row is kept. One thread at
// a time. Times are seconds of the session.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <telemetry/expression/expression.h>
#include <telemetry/query/query_rows.h>

namespace pitchboard::telemetry {

/// In an expression: every robot that has the variables. A name without a group is of it, too.
inline constexpr const char* eachRobot = "each";

/// An expression whose values are wanted.
struct QueryText {
  std::string value;
  std::string condition{};  ///< where it does not hold, a value does not count; may be empty
  std::vector<std::string> robots{};  ///< that `each` stands for; all if empty
};
/// Expressions with the same condition and robots.
struct QueryTexts {
  std::vector<std::string> values;
  std::string condition;
  std::vector<std::string> robots;
};

/// An expression with every name resolved.
struct QueryCurve {
  std::size_t value = 0;  ///< index of its text
  std::string robot;      ///< name of the group that `each` stands for, or of the first variable
  bool isOfEach = false;  ///< it has names without a robot
  std::string unit;       ///< empty if there is none or it is unknown
  ColumnKind kind = ColumnKind::Number;        ///< of a single variable; else Number
  std::map<std::int32_t, std::string> labels;  ///< of a single variable
};

struct QuerySample {
  std::size_t curve = 0;
  double time = 0.0;
  double value = 0.0;         ///< NaN if it is unknown
  bool isConditioned = true;  ///< the condition holds; true without one
};

/// A variable of a session.
struct QueryVariable {
  GroupId group = 0;
  std::uint32_t column = 0;
  auto operator<=>(const QueryVariable&) const = default;
};

class SessionQuery {
 public:
  /// Resolves the names. A robot that has some of the variables of `each` only has no curve. Fails
  /// with ParseError, and with NotFound if the session has no such robot or variable; the error
  /// names a similar one.
  static Result<SessionQuery> of(const QueryRows& rows, std::span<const QueryText> texts);
  static Result<SessionQuery> of(const QueryRows& rows, const QueryTexts& texts);
  SessionQuery(SessionQuery&&) noexcept;
  SessionQuery& operator=(SessionQuery&&) noexcept;
  ~SessionQuery();

  /// Ordered by value, then as robots are listed.
  std::span<const QueryCurve> curves() const;
  /// Returns the variables of a curve's value and of its condition, with the names that
  /// Expression::variables() gives them. The curve has its samples at the rows of the first one.
  std::vector<std::pair<std::string, QueryVariable>> variables(std::size_t curve) const;

  /// Visits the samples of all curves in a closed range, in order of time, until `visit` returns
  /// false. `progress` is called from time to time with the share that is done (0 to 1). Returns
  /// false if one of them stopped it. `rows` has the groups of of().
  bool run(const QueryRows& rows, TimeRange range,
           const std::function<bool(const QuerySample&)>& visit,
           const std::function<bool(double)>& progress = {});

 private:
  struct Impl;
  explicit SessionQuery(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
