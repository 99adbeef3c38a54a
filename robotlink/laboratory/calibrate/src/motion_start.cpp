// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_start.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <base/angles.h>

#include "gait_step.h"

namespace pitchboard::link {
namespace {

constexpr double maxLook = 20.0;  // s
constexpr double maxBlink = 0.5;  // s without rows; what was before is of no use then
constexpr std::size_t maxSights = 1500;
constexpr std::size_t fewestSights = 20;
constexpr int fewestOfCorner = 3;
constexpr double maxSpread = 0.2;      // m, of a place that is known well
constexpr double minSpread = 0.05;     // m
constexpr double minYawSpread = 0.02;  // rad
constexpr double rivalCost = 5.0;      // of another place that explains the corners nearly as well
constexpr double oddBearing = 0.2;     // rad; bearings that are farther off count less

/// A corner that was seen on the way, which begins at the origin.
struct Sight {
  double x, y, yaw;  // m and rad, of the robot
  Point corner;
  double bearing;
};

/// What is looked for: the first pose, and by which share of itself the way is longer than the
/// gait of the model makes it.
struct Candidate {
  Pose pose;
  double stretch = 0.0;
  double cost = 0.0;
};

struct Look {
  std::vector<Sight> sights;
  int corners = 0;          // different ones
  double walkedFrames = 0;  // 1/60 s
};

Look lookFrom(const CalibrationLog& log, const std::vector<ExecutedAction>& actions,
              const sim::RobotModel& model, double delay, std::size_t first) {
  struct Place {
    double time, x, y, yaw;
  };
  Look out;
  std::vector<Place> trajectory;
  std::size_t image = 0;  // in `way`
  const std::array<Point, 4> corners = fieldCorners(log.field);
  std::array<int, 4> seen{};
  GaitStep gait;
  double x = 0.0, y = 0.0, yaw = 0.0;
  std::optional<double> imuZero;  // the first rows may have no value yet
  for (std::size_t i = first; i < log.rows.size(); ++i) {
    const CalibrationRow& row = log.rows[i];
    if (row.time - log.rows[first].time > maxLook || out.sights.size() >= maxSights) break;
    if (i > first) {
      const double dt = row.time - log.rows[i - 1].time;
      if (dt > std::max(maxBlink, 3.0 * log.period) || actions[i].down) break;
      gait.advance(model, actions[i], dt);
      yaw = imuZero && row.imuYaw ? wrapToPi(*row.imuYaw - *imuZero) : yaw + gait.turn * dt;
      x += (std::cos(yaw) * gait.forward - std::sin(yaw) * gait.left) * dt;
      y += (std::sin(yaw) * gait.forward + std::cos(yaw) * gait.left) * dt;
      if (gait.moves) out.walkedFrames += dt * 60.0;
    }
    if (!imuZero && row.imuYaw) imuZero = wrapToPi(*row.imuYaw - yaw);
    trajectory.push_back({row.time, x, y, yaw});
    const double taken = row.time - delay;
    if (taken < trajectory.front().time - 1e-6) continue;
    while (image + 1 < trajectory.size() && trajectory[image + 1].time <= taken + 0.25 * log.period)
      ++image;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (!row.corners[c]) continue;
      out.sights.push_back({trajectory[image].x, trajectory[image].y, trajectory[image].yaw,
                            corners[c], *row.corners[c]});
      ++seen[c];
    }
  }
  out.corners = static_cast<int>(
      std::ranges::count_if(seen, [](int count) { return count >= fewestOfCorner; }));
  return out;
}

/// What a sight of a candidate is off by, and how that depends on x, y, yaw and stretch.
struct Residual {
  double error = 0.0;
  Eigen::Vector4d slope;
  Residual(const Sight& sight, const Candidate& from, double c, double s) {
    const double wx = c * sight.x - s * sight.y, wy = s * sight.x + c * sight.y;
    const double ox = wx * (1.0 + from.stretch), oy = wy * (1.0 + from.stretch);
    const double dx = sight.corner.x - from.pose.position.x - ox;
    const double dy = sight.corner.y - from.pose.position.y - oy;
    const double square = std::max(0.01, dx * dx + dy * dy);
    error = wrapToPi(std::atan2(dy, dx) - from.pose.yaw - sight.yaw - sight.bearing);
    slope = {dy / square, -dx / square, -1.0 - (dy * oy + dx * ox) / square,
             (dy * wx - dx * wy) / square};
  }
};

/// Minus the logarithm of a likelihood of the Cauchy distribution.
double costOf(const std::vector<Sight>& sights, const Candidate& from) {
  const double c = std::cos(from.pose.yaw), s = std::sin(from.pose.yaw);
  double sum = 0.0, product = 1.0;
  for (const Sight& sight : sights) {
    const double error = Residual(sight, from, c, s).error;
    product *= 1.0 + error * error / (oddBearing * oddBearing);
    if (product < 1e100) continue;
    sum += std::log(product);  // far more expensive than a product
    product = 1.0;
  }
  return sum + std::log(product);
}

/// Evenly spread, at most so many.
std::vector<Sight> thinned(const std::vector<Sight>& sights, std::size_t most) {
  const std::size_t stride = std::max<std::size_t>(1, sights.size() / most);
  std::vector<Sight> out;
  for (std::size_t i = 0; i < sights.size(); i += stride) out.push_back(sights[i]);
  return out;
}

/// The best poses of a grid over the field, best first.
std::vector<Candidate> candidatesOf(const std::vector<Sight>& sights, const sim::FieldSpec& field) {
  constexpr double stepXy = 0.75;
  constexpr int directions = 16;
  constexpr std::size_t kept = 6;
  const double halfX = field.halfLength() + 0.5, halfY = field.halfWidth() + 0.5;
  std::vector<Candidate> all;
  for (double x = -halfX; x <= halfX; x += stepXy) {
    for (double y = -halfY; y <= halfY; y += stepXy) {
      for (int k = 0; k < directions; ++k) {
        Candidate one{{{x, y}, wrapToPi(k * 2.0 * std::numbers::pi / directions)}};
        one.cost = costOf(sights, one);
        all.push_back(one);
      }
    }
  }
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(kept, all.size()));
  std::partial_sort(all.begin(), end, all.end(),
                    [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  all.erase(end, all.end());
  return all;
}

/// By Gauss and Newton, with weights of the Cauchy distribution; gives the normal equations.
/// `precision`: of the stretch, in units of the error of a bearing.
Eigen::Matrix4d refine(const std::vector<Sight>& sights, double precision, Candidate& at) {
  Eigen::Matrix4d normal;
  for (int round = 0; round < 30; ++round) {
    normal = Eigen::Matrix4d::Identity() * 1e-6;
    Eigen::Vector4d slope = Eigen::Vector4d::Zero();
    normal(3, 3) += precision;
    slope[3] += precision * at.stretch;
    const double c = std::cos(at.pose.yaw), s = std::sin(at.pose.yaw);
    for (const Sight& sight : sights) {
      const Residual one(sight, at, c, s);
      const double weight = 1.0 / (1.0 + one.error * one.error / (oddBearing * oddBearing));
      normal += weight * one.slope * one.slope.transpose();
      slope += weight * one.error * one.slope;
    }
    const Eigen::Vector4d move = normal.ldlt().solve(slope);
    const double length = std::max(1.0, move.head<2>().norm() / 0.5);
    at.pose.position.x -= move[0] / length;
    at.pose.position.y -= move[1] / length;
    at.pose.yaw = wrapToPi(at.pose.yaw - move[2] / length);
    at.stretch -= move[3] / length;
    if (move.norm() < 1e-5) break;
  }
  at.cost = costOf(sights, at) + precision * at.stretch * at.stretch / (oddBearing * oddBearing);
  return normal;
}

}  // namespace

std::optional<MotionStart> startFromCorners(const CalibrationLog& log,
                                            const std::vector<ExecutedAction>& actions,
                                            const sim::RobotModel& model, double gaitSpread,
                                            double delay, std::uint32_t row) {
  const Look look = lookFrom(log, actions, model, delay, row);
  // Corners have names, so that there is only one such pose once three were seen.
  if (look.sights.size() < fewestSights || look.corners < 3) return {};
  const double sigma = model.noise.landmarkBearing > 0.0 ? model.noise.landmarkBearing : 0.05;
  const double precision = sigma * sigma / (gaitSpread * gaitSpread);
  const std::vector<Sight> some = thinned(look.sights, 150);
  std::vector<Candidate> candidates = candidatesOf(thinned(look.sights, 40), log.field);
  for (Candidate& one : candidates) refine(some, precision, one);
  Candidate best = *std::ranges::min_element(candidates, {}, &Candidate::cost);
  for (const Candidate& one : candidates) {
    const double apart = std::hypot(one.pose.position.x - best.pose.position.x,
                                    one.pose.position.y - best.pose.position.y);
    if (apart > 2.0 * maxSpread && one.cost < best.cost + rivalCost) return {};
  }
  const Eigen::Matrix4d normal = refine(look.sights, precision, best);
  const double walked = look.walkedFrames * (model.noise.forward * model.noise.forward +
                                             model.noise.sideways * model.noise.sideways);
  const Eigen::Matrix3d covariance = sigma * sigma * normal.inverse().topLeftCorner<3, 3>();
  if (!(covariance(0, 0) + covariance(1, 1) < maxSpread * maxSpread)) return {};
  // The filter sees the same corners again: twice the deviation leaves them their say. A wide start
  // would make an extended filter too sure of what it has linearized about.
  MotionStart start;
  start.row = row;
  start.pose = best.pose;
  start.covariance = 4.0 * covariance;
  const double place = minSpread * minSpread + walked;
  start.covariance.diagonal() += Eigen::Vector3d(place, place, minYawSpread * minYawSpread);
  return start;
}

MotionStart startFromBelief(std::uint32_t row, const CalibrationRow::Belief& belief) {
  MotionStart start;
  start.row = row;
  start.pose = belief.pose;
  const double spread = std::max(0.1, belief.sigma);
  start.covariance.diagonal() = Eigen::Vector3d(spread * spread, spread * spread, 0.1 * 0.1);
  return start;
}

}  // namespace pitchboard::link
