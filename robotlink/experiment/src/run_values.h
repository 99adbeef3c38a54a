// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a run's measure is made of: a mean, an expression with its reduction, a way on the field
// that stays short. One thread.

#include <string>
#include <vector>

#include <base/geometry.h>
#include <robotlink/experiment/experiment.h>
#include <telemetry/expression/expression.h>

#include "latest_rows.h"

namespace pitchboard::link {

/// Of the values that are known.
class MeanOf {
 public:
  void add(double value);
  double mean() const;  ///< NaN without any
  double last() const { return m_last; }

 private:
  double m_sum = 0.0, m_last = 0.0;
  std::size_t m_count = 0;
};

/// A metric of the file: its expression, evaluated with every sample.
class ReducedExpression {
 public:
  /// Fails when a variable is not recorded.
  static Result<ReducedExpression> make(const ExpressionMetric& metric, const LatestRows& rows);
  void sample(double time, const LatestRows& rows);
  double value() const;

 private:
  ReducedExpression(telemetry::Expression expression, std::vector<LatestRows::Place> places,
                    Reduction reduction)
      : m_expression(std::move(expression)),
        m_places(std::move(places)),
        m_reduction(reduction),
        m_values(m_places.size()) {}

  telemetry::Expression m_expression;
  std::vector<LatestRows::Place> m_places;
  Reduction m_reduction;
  std::vector<double> m_values;  // scratch
  MeanOf m_mean;
  std::size_t m_count = 0;
  double m_first = 0.0, m_least = 0.0, m_most = 0.0, m_integral = 0.0, m_time = 0.0;
  int m_changes = 0;
  bool m_true = false;
  std::vector<double> m_all;  // only for p95
};

/// Keeps a point where it has gone far enough; of a long way every second one goes, again and
/// again.
class PathFollower {
 public:
  explicit PathFollower(std::string who) : m_who(std::move(who)) {}
  void follow(const Point& at);
  /// Whole centimetres, which is what a drawing can show.
  std::vector<Point> points() const;
  const std::string& who() const { return m_who; }

 private:
  std::string m_who;
  double m_step = 0.02;  // m
  std::vector<Point> m_points;
  Point m_last;
};

}  // namespace pitchboard::link
