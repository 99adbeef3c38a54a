// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <telemetry/statistics/distributions.h>

#include "gait_step.h"

namespace pitchboard::link {
namespace {

constexpr double window = 5.0;          // s
constexpr double windowInterval = 1.0;  // s
constexpr double minWalking = 2.0;      // s of a window
constexpr double placeInterval = 0.1;   // s
constexpr std::size_t timeParts = 60;

/// Where a model walks from a state with recorded actions.
struct Walk {
  const sim::RobotModel& model;
  GaitStep gait;
  double x = 0.0, y = 0.0, yaw = 0.0;
  void advance(const ExecutedAction& action, double dt) {
    gait.advance(model, action, dt);
    yaw += gait.turn * dt;
    x += (std::cos(yaw) * gait.forward - std::sin(yaw) * gait.left) * dt;
    y += (std::sin(yaw) * gait.forward + std::cos(yaw) * gait.left) * dt;
  }
};

void checkLog(const CalibrationLog& log, std::size_t session, double holdOut,
              const MotionFit& motion, Calibration& out, double& sum, double& sumBase) {
  MotionFilter filter(log, out.base);
  filter.findDisturbed(motion.model, motion.delay);
  filter.findJumps(motion.model, motion.delay);
  FilterDecisions decisions;
  std::vector<Innovation> innovations;
  std::vector<MotionState> states;
  filter.run(motion.model, motion.delay, decisions, innovations, &states);
  const auto& rows = log.rows;
  const double end = rows.back().time;
  double next = holdOut > 0.0 ? end - holdOut * (end - rows.front().time) : rows.front().time;
  for (std::size_t i = 0; i < rows.size() && rows[i].time + window <= end; ++i) {
    if (rows[i].time < next || !states[i].known) continue;
    next = rows[i].time + windowInterval;
    PredictedWindow shown;
    shown.session = session;
    shown.time = rows[i].time;
    const MotionState& from = states[i];
    const auto begin = [&](const sim::RobotModel& model) {
      Walk walk{model,
                {},
                from.mean[MotionState::X],
                from.mean[MotionState::Y],
                from.mean[MotionState::Yaw]};
      walk.gait.forward = from.forward;
      walk.gait.left = from.left;
      walk.gait.turn = from.turn;
      return walk;
    };
    Walk calibrated = begin(motion.model), base = begin(out.base);
    double walking = 0.0, lastShown = -1e9;
    bool whole = true;
    std::size_t k = i + 1;
    for (; k < rows.size() && rows[k].time <= rows[i].time + window + 1e-6; ++k) {
      const double dt = rows[k].time - rows[k - 1].time;
      whole = whole && states[k].known && dt < 0.5 && !filter.actions()[k].down &&
              !filter.disturbed()[k];
      calibrated.advance(filter.actions()[k], dt);
      base.advance(filter.actions()[k], dt);
      if (calibrated.gait.moves) walking += dt;
      if (rows[k].time - lastShown >= placeInterval) {
        lastShown = rows[k].time;
        shown.places.push_back({rows[k].time,
                                {states[k].mean[MotionState::X], states[k].mean[MotionState::Y]},
                                {calibrated.x, calibrated.y},
                                {base.x, base.y}});
      }
    }
    if (!whole || walking < minWalking) continue;
    const MotionState& to = states[k - 1];
    const double x = to.mean[MotionState::X], y = to.mean[MotionState::Y];
    sum += (calibrated.x - x) * (calibrated.x - x) + (calibrated.y - y) * (calibrated.y - y);
    sumBase += (base.x - x) * (base.x - x) + (base.y - y) * (base.y - y);
    out.check.windows.push_back(std::move(shown));
  }
}

}  // namespace

void checkPredictions(std::span<const CalibrationLog> logs, double holdOut, const MotionFit& motion,
                      Calibration& out) {
  out.check.window = window;
  double sum = 0.0, sumBase = 0.0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    checkLog(logs[i], i, holdOut, motion, out, sum, sumBase);
  }
  if (out.check.windows.empty()) return;
  const auto count = static_cast<double>(out.check.windows.size());
  out.check.rms = std::sqrt(sum / count);
  out.check.rmsBase = std::sqrt(sumBase / count);
}

void describeResiduals(const MotionFit& motion, Calibration& out) {
  const std::array<std::pair<Sense, const char*>, 6> senses{
      {{Sense::Imu, "IMU yaw"},
       {Sense::BallDistance, "ball distance"},
       {Sense::BallBearing, "ball bearing"},
       {Sense::Corner, "corner bearing"},
       {Sense::Belief, "believed pose"},
       {Sense::TeamMate, "seen by team-mates"}}};
  for (const auto& [sense, name] : senses) {
    std::vector<double> all;
    for (const MotionFit::OfLog& log : motion.ofLogs) {
      for (const Innovation& one : log.innovations) {
        if (one.sense == sense) all.push_back(one.value / std::sqrt(one.variance));
      }
    }
    if (all.size() < 2) continue;
    CalibrationResiduals residuals;
    residuals.sense = name;
    residuals.count = all.size();
    const auto count = static_cast<double>(all.size());
    residuals.mean = std::accumulate(all.begin(), all.end(), 0.0) / count;
    // Deviation and autocorrelation are both about the mean, so that a constant bias is neither.
    double squares = 0.0, products = 0.0;
    std::vector<double> parts(std::min(timeParts, all.size())), counts(parts.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double off = all[i] - residuals.mean;
      squares += off * off;
      if (i > 0) products += off * (all[i - 1] - residuals.mean);
      const std::size_t part = i * parts.size() / all.size();
      parts[part] += all[i] * all[i];
      counts[part] += 1.0;
    }
    residuals.deviation = std::sqrt(squares / count);
    residuals.autocorrelation = squares > 0.0 ? products / squares : 0.0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      residuals.overTime.push_back(std::sqrt(parts[p] / std::max(1.0, counts[p])));
    }
    std::ranges::sort(all);
    for (double z = -2.0; z <= 2.01; z += 0.5) {
      const double at = telemetry::normalCdf(z) * (count - 1.0);
      residuals.quantiles.push_back(all[static_cast<std::size_t>(at)]);
    }
    out.residuals.push_back(std::move(residuals));
  }
}

}  // namespace pitchboard::link
