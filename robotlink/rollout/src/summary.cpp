// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rollout/summary.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitchboard::rollout {
namespace {

double cell(std::span<const double> row, Column column) {
  return row[static_cast<std::size_t>(column)];
}

template <class Use>
void forEachRow(std::span<const double> outcomes, const Use& use) {
  for (std::size_t at = 0; at + columnCount <= outcomes.size(); at += columnCount) {
    const auto row = outcomes.subspan(at, columnCount);
    if (!std::isnan(cell(row, Column::Time))) use(row);
  }
}

}  // namespace

Share shareOf(double hits, double count) {
  constexpr double z = 1.959963984540054;
  if (count <= 0.0) return {};
  const double p = hits / count, scale = 1.0 + z * z / count;
  const double middle = (p + z * z / (2.0 * count)) / scale;
  const double half = z / scale * std::sqrt(p * (1.0 - p) / count + z * z / (4.0 * count * count));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

OutcomeSummary summaryOf(std::span<const double> outcomes) {
  OutcomeSummary out;
  double n = 0.0, left = 0.0, right = 0.0, difference = 0.0, time = 0.0, timed = 0.0;
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0;
  forEachRow(outcomes, [&](std::span<const double> row) {
    n += 1.0;
    left += cell(row, Column::GoalsLeft) > 0.0 ? 1.0 : 0.0;
    right += cell(row, Column::GoalsRight) > 0.0 ? 1.0 : 0.0;
    difference += cell(row, Column::GoalsLeft) - cell(row, Column::GoalsRight);
    if (const double t = cell(row, Column::TimeToGoal); !std::isnan(t)) {
      time += t;
      timed += 1.0;
    }
    const double bx = cell(row, Column::BallX), by = cell(row, Column::BallY);
    x += bx;
    y += by;
    xx += bx * bx;
    yy += by * by;
  });
  out.rollouts = static_cast<std::size_t>(n);
  out.goalLeft = shareOf(left, n);
  out.goalRight = shareOf(right, n);
  out.timeToGoal = timed > 0.0 ? time / timed : std::numeric_limits<double>::quiet_NaN();
  if (n <= 0.0) return out;
  out.goalDifference = difference / n;
  out.ball = {x / n, y / n};
  out.ballSigmaX = std::sqrt(std::max(0.0, xx / n - out.ball.x * out.ball.x));
  out.ballSigmaY = std::sqrt(std::max(0.0, yy / n - out.ball.y * out.ball.y));
  return out;
}

std::size_t heatCell(const Point& ball, const sim::FieldSpec& field, int columns, int rows) {
  const auto cellOf = [](double place, double half, int count) {
    const double share = (place + half) / (2.0 * half);
    return static_cast<std::size_t>(std::clamp(static_cast<int>(share * count), 0, count - 1));
  };
  return cellOf(ball.y, field.halfWidth(), rows) * static_cast<std::size_t>(columns) +
         cellOf(ball.x, field.halfLength(), columns);
}

std::vector<double> heatMap(std::span<const double> outcomes, const sim::FieldSpec& field,
                            int columnsX, int rowsY) {
  columnsX = std::max(1, columnsX);
  rowsY = std::max(1, rowsY);
  std::vector<double> cells(static_cast<std::size_t>(columnsX) * static_cast<std::size_t>(rowsY));
  double n = 0.0;
  forEachRow(outcomes, [&](std::span<const double> row) {
    const Point ball{cell(row, Column::LookX), cell(row, Column::LookY)};
    cells[heatCell(ball, field, columnsX, rowsY)] += 1.0;
    n += 1.0;
  });
  if (n > 0.0) {
    for (double& share : cells) share /= n;
  }
  return cells;
}

}  // namespace pitchboard::rollout
