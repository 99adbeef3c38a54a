// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/try.h>
#include <robotlink/experiment/statistics.h>
#include <robotlink/report/quantile.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t mostPoints = 400;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Point inCentimetres(const Point& p) {
  return {std::round(p.x * 100.0) / 100.0, std::round(p.y * 100.0) / 100.0};
}

}  // namespace

void MeanOf::add(double value) {
  if (!std::isfinite(value)) return;
  m_sum += value;
  m_last = value;
  ++m_count;
}

double MeanOf::mean() const {
  return m_count > 0 ? m_sum / static_cast<double>(m_count) : nan;
}

Result<ReducedExpression> ReducedExpression::make(const ExpressionMetric& metric,
                                                  const LatestRows& rows) {
  auto expression = TRY(telemetry::Expression::parse(metric.expression));
  std::vector<LatestRows::Place> places;
  for (const std::string& variable : expression.variables()) {
    const std::size_t slash = variable.find('/');
    const auto place = rows.find(variable.substr(0, slash), variable.substr(slash + 1));
    if (!place) {
      return failure(ErrorCode::NotFound,
                     "there is no variable " + variable +
                         " in this match; groups are the robots' "
                         "names and \"match\" (docs/PLOTS.md)",
                     "metrics: " + metric.name);
    }
    places.push_back(*place);
  }
  return ReducedExpression(std::move(expression), std::move(places), metric.reduction);
}

void ReducedExpression::sample(double time, const LatestRows& rows) {
  for (std::size_t i = 0; i < m_places.size(); ++i) m_values[i] = rows.value(m_places[i]);
  const double value = m_expression.evaluate(time, m_values);
  if (!std::isfinite(value)) return;
  const bool isTrue = value != 0.0;
  m_changes += isTrue && !m_true;
  m_true = isTrue;
  if (m_count > 0) {
    m_integral += (time - m_time) * (value + m_mean.last()) / 2.0;
  } else {
    m_first = m_least = m_most = value;
  }
  m_least = std::min(m_least, value);
  m_most = std::max(m_most, value);
  m_mean.add(value);
  m_time = time;
  ++m_count;
  if (m_reduction == Reduction::P95) m_all.push_back(value);
}

double ReducedExpression::value() const {
  if (m_count == 0) return nan;
  switch (m_reduction) {
    case Reduction::Mean:
      return m_mean.mean();
    case Reduction::Least:
      return m_least;
    case Reduction::Most:
      return m_most;
    case Reduction::First:
      return m_first;
    case Reduction::Last:
      return m_mean.last();
    case Reduction::Sum:
      return m_integral;
    case Reduction::Changes:
      return m_changes;
    case Reduction::P95:
      break;
  }
  std::vector<double> sorted = m_all;
  std::sort(sorted.begin(), sorted.end());
  return quantile(sorted, 0.95);
}

void PathFollower::follow(const Point& at) {
  m_last = at;
  if (!m_points.empty() && distance(m_points.back(), at) < m_step) return;
  m_points.push_back(at);
  if (m_points.size() < mostPoints) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < m_points.size(); i += 2) m_points[kept++] = m_points[i];
  m_points.resize(kept);
  m_step *= 2.0;
}

std::vector<Point> PathFollower::points() const {
  std::vector<Point> out;
  for (const Point& point : m_points) out.push_back(inCentimetres(point));
  if (const Point last = inCentimetres(m_last); out.empty() || out.back() != last) {
    out.push_back(last);
  }
  return out;
}

}  // namespace pitchboard::link
