// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/calibrate/calibrate.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

#include <base/angles.h>
#include <robotlink/calibrate/calibration_file.h>
#include <simcore/world/action_codes.h>
#include <simcore/world/parameters.h>
#include <telemetry/statistics/distributions.h>

#include "calibration_check.h"
#include "kick_fit.h"
#include "motion_fit.h"
#include "percept_fit.h"

namespace pitchboard::link {
namespace {

constexpr double learnedEnough = 0.5;   // share of the prior's variance that must have gone
constexpr double shortestAction = 0.5;  // s
const double normal95 = 1.959963984540054;

constexpr const char* rollingKey = "field.rolling_deceleration";

const std::vector<std::string>& furtherKeys() {
  static const std::vector<std::string> keys{"kick_speed",
                                             "weak_kick_speed",
                                             "pass_speed",
                                             "kick_time",
                                             "kick_contact",
                                             "get_up_front",
                                             "get_up_back",
                                             "field_of_view",
                                             "vision_range",
                                             "noise.kick_speed",
                                             "noise.kick_angle",
                                             "noise.robot_distance",
                                             "noise.robot_bearing",
                                             "noise.landmark_probability",
                                             "noise.missed_detection",
                                             "noise.vision_delay",
                                             rollingKey};
  return keys;
}

/// Standard deviation of the prior of a number's logarithm; empty for those that have another one.
std::optional<double> priorDeviation(const std::string& key) {
  for (const MotionParameter& parameter : motionParameters) {
    if (key == parameter.key) return parameter.prior;
  }
  if (key == "noise.landmark_probability" || key == "noise.missed_detection" || key == rollingKey)
    return {};
  if (key == "field_of_view" || key == "vision_range") return viewPrior;
  return key.starts_with("noise.") ? sigmaPrior : speedPrior;
}

/// What a recording does not show.
const std::vector<const char*>& hiddenKeys() {
  static const std::vector<const char*> keys{
      "radius",         "mass",          "fall_impulse", "foot_side",   "foot_width",
      "kick_reach",     "kick_outer",    "kick_inner",   "head_speed",  "pan_limit",
      "camera_forward", "camera_height", "battery_full", "battery_low", "battery_empty"};
  return keys;
}

struct Counts {
  std::map<int, std::size_t> actions;  // by code
  std::size_t moving = 0, imu = 0, ball = 0, corners = 0;
};

Counts countsOf(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs) {
  Counts counts;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const auto& actions = filters[f].actions();
    double began = 0.0;
    bool counted = true;
    for (std::size_t i = 0; i < logs[f].rows.size(); ++i) {
      const CalibrationRow& row = logs[f].rows[i];
      if (actions[i].began) {
        began = row.time;
        counted = false;
      }
      if (!counted && row.time - began >= shortestAction && !actions[i].kicks && !actions[i].down) {
        ++counts.actions[actions[i].code];
        counted = true;
      }
      if (sim::gaitSpeed({}, actions[i].code, 10).inMotion) ++counts.moving;
      if (row.imuYaw) ++counts.imu;
      if (row.ball) ++counts.ball;
      for (const auto& corner : row.corners) counts.corners += corner ? 1 : 0;
    }
  }
  return counts;
}

void addMotion(const MotionFit& fit, const Counts& counts, Calibration& out) {
  for (std::size_t i = 0; i < fit.logs.size(); ++i) {
    const MotionParameter& parameter = motionParameters[i];
    std::size_t samples = 0;
    std::string of = "actions";
    for (const int action : actionsOf(i)) {
      const auto found = counts.actions.find(action);
      if (found != counts.actions.end()) samples += found->second;
    }
    if (i >= motionNoiseForward) {
      of = "rows";
      samples = i == motionImuWhite || i == motionImuDrift ? counts.imu : counts.moving;
      if (i == motionBallDistance || i == motionBallBearing) samples = counts.ball;
      if (i == motionLandmark) samples = counts.corners;
      if (i >= motionBallDistance && i <= motionLandmark) of = "percepts";
    }
    if (samples == 0) {
      out.kept[parameter.key] = i < motionNoiseForward ? "the robot did not do this for long enough"
                                                       : "no such measurements were recorded";
      continue;
    }
    if (fit.information[i] < learnedEnough) {
      out.kept[parameter.key] = "the recording says too little about it";
      continue;
    }
    const GridPosterior& log = fit.marginals[i];
    take(out,
         {parameter.key, std::exp(log.median), std::exp(log.low), std::exp(log.high), samples, of});
  }
  const std::size_t images = counts.ball + counts.corners;
  if (fit.delayKnown) {
    take(out, {"noise.vision_delay", fit.delayPosterior.median, fit.delayPosterior.low,
               fit.delayPosterior.high, images, "percepts"});
  } else {
    out.kept["noise.vision_delay"] =
        images == 0 ? "no percepts were recorded" : "the robot turned too little";
  }
}

/// Seconds to reach and to leave a speed follow from two numbers of the gait: the logarithm of
/// their quotient is normal.
void reportTimes(const MotionFit& fit, Calibration& out) {
  const auto add = [&](const char* name, std::size_t speed, std::size_t acceleration) {
    if (fit.information[speed] < learnedEnough || fit.information[acceleration] < learnedEnough) {
      return;
    }
    const auto s = static_cast<Eigen::Index>(speed), a = static_cast<Eigen::Index>(acceleration);
    const double middle = fit.logs[speed] - fit.logs[acceleration];
    const double half =
        normal95 * std::sqrt(std::max(0.0, fit.covariance(s, s) + fit.covariance(a, a) -
                                               2.0 * fit.covariance(s, a)));
    const CalibratedValue* of = out.find(motionParameters[speed].key);
    out.estimates.push_back({name, std::exp(middle), std::exp(middle - half),
                             std::exp(middle + half), of != nullptr ? of->samples : 0, "actions"});
  };
  add("forward, fast: time to start and stop", motionForwardFast, motionAcceleration);
  add("forward, slow: time to start and stop", motionForwardSlow, motionAcceleration);
  add("backward, fast: time to start and stop", motionBackwardFast, motionAcceleration);
  add("backward, slow: time to start and stop", motionBackwardSlow, motionAcceleration);
  add("sideways: time to start and stop", motionSideways, motionAcceleration);
  add("turning: time to start and stop", motionTurn, motionYawAcceleration);
}

/// How far an uninterrupted action went, as the filter found it, as a share of what the gait of the
/// fitted model makes of the same commands; empty for one that is too short or not known
/// throughout.
std::optional<double> actionShare(const CalibrationLog& log, const MotionFit::OfLog& fit,
                                  std::size_t first, std::size_t last, bool turns) {
  constexpr double longEnough = 2.0;  // s
  const MotionState &from = fit.states[first], &to = fit.states[last];
  if (log.rows[last].time - log.rows[first].time < longEnough) return {};
  double turned = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    if (!fit.states[i].known) return {};
    if (i > first) turned += fit.states[i].turn * (log.rows[i].time - log.rows[i - 1].time);
  }
  if (turns) {
    if (std::abs(turned) < 0.2) return {};
    return (to.mean[MotionState::Yaw] - from.mean[MotionState::Yaw]) / turned;
  }
  const double ox = to.odometryX - from.odometryX, oy = to.odometryY - from.odometryY;
  const double square = ox * ox + oy * oy;
  if (square < 0.04) return {};
  const double x = to.mean[MotionState::X] - from.mean[MotionState::X];
  const double y = to.mean[MotionState::Y] - from.mean[MotionState::Y];
  return (x * ox + y * oy) / square;
}

/// The spread of a speed between actions: standard deviation with its interval from the chi-square
/// distribution. RobotModel has no number for it; part of it is the noise of every step.
void reportSpreads(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                   const MotionFit& fit, Calibration& out) {
  std::map<std::size_t, std::vector<double>> shares;  // by parameter
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const auto& actions = filters[f].actions();
    for (std::size_t first = 0; first < actions.size();) {
      std::size_t end = first + 1;
      while (end < actions.size() && !actions[end].began && !actions[end].down) ++end;
      for (std::size_t p = 0; p <= motionAroundSideways; ++p) {
        if (!actionsOf(p).contains(actions[first].code) || actions[first].kicks) continue;
        if (const auto share =
                actionShare(logs[f], fit.ofLogs[f], first, end - 1, p == motionTurn)) {
          shares[p].push_back(*share);
        }
      }
      first = end;
    }
  }
  for (const auto& [parameter, all] : shares) {
    if (all.size() < 3) continue;
    const auto n = static_cast<double>(all.size());
    double mean = 0.0, squares = 0.0;
    for (const double one : all) mean += one / n;
    for (const double one : all) squares += (one - mean) * (one - mean);
    const double speed = std::exp(fit.logs[parameter]);
    const auto sigma = [&](double freedom) { return speed * std::sqrt(squares / freedom); };
    out.estimates.push_back(
        {std::string(motionParameters[parameter].key) + ": spread between actions", sigma(n - 1.0),
         sigma(telemetry::chiSquaredQuantile(n - 1.0, 0.975)),
         sigma(telemetry::chiSquaredQuantile(n - 1.0, 0.025)), all.size(), "actions"});
  }
}

/// What the filter left out, by cause.
void reportLeftOut(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                   const MotionFit& fit, Calibration& out) {
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const auto& actions = filters[f].actions();
    std::string before;
    for (std::size_t i = 1; i < logs[f].rows.size(); ++i) {
      const double dt = logs[f].rows[i].time - logs[f].rows[i - 1].time;
      std::string cause;
      if (dt > 0.5 && logs[f].period < 0.5) {
        cause = "gaps";
      } else if (actions[i].down) {
        cause = "fallen or getting up";
      } else if (!fit.ofLogs[f].states[i].known) {
        cause = "the pose is not known";
      } else if (filters[f].pushed()[i]) {
        cause = "moved by something that it did not see";
      } else if (filters[f].disturbed()[i]) {
        cause = "possibly touching the ball, another robot, a goal or a wall";
      }
      if (!cause.empty()) {
        LeftOut& leftOut = out.leftOut[cause];
        leftOut.seconds += dt;
        if (cause != before) ++leftOut.stretches;
      }
      before = std::move(cause);
    }
    const FilterDecisions& decisions = fit.ofLogs[f].decisions;
    const auto note = [&](const std::string& what, std::size_t count) {
      if (count == 0) return;
      out.notes.push_back(logs[f].session + ": " + what + ": " + std::to_string(count) + '.');
    };
    note("Measurements left out as outliers", decisions.outliers);
    note("Resets of the IMU", decisions.imuResets);
    const auto& moves = filters[f].ballMoves();
    std::size_t ballMoves = decisions.ballMoves;
    for (std::size_t i = 1; i < moves.size(); ++i) ballMoves += moves[i] && !moves[i - 1] ? 1 : 0;
    note("Moves of the ball by others", ballMoves);
    note("Times the robot was carried or lost its position", decisions.jumps);
  }
}

CalibrationLog firstPart(const CalibrationLog& log, double holdOut) {
  CalibrationLog out = log;
  const double end =
      log.rows.back().time - holdOut * (log.rows.back().time - log.rows.front().time);
  std::erase_if(out.rows, [end](const CalibrationRow& row) { return row.time > end; });
  std::erase_if(out.robots,
                [&](const SeenRobotPercept& seen) { return seen.row >= out.rows.size(); });
  std::erase_if(out.sightings,
                [&](const TeamMateSighting& seen) { return seen.row >= out.rows.size(); });
  return out;
}

}  // namespace

std::string residualsText(const CalibrationResiduals& residuals) {
  char text[128];
  std::snprintf(text, sizeof text,
                "%zu measurements, bias %.2f, deviation %.2f, autocorrelation %.2f",
                residuals.count, residuals.mean, residuals.deviation, residuals.autocorrelation);
  return text;
}

std::vector<std::string> leftOutTexts(const Calibration& calibration) {
  std::vector<std::string> out;
  for (const auto& [cause, leftOut] : calibration.leftOut) {
    char text[64];
    std::snprintf(text, sizeof text, "Left out: %.1f s in %zu stretch%s, ", leftOut.seconds,
                  leftOut.stretches, leftOut.stretches == 1 ? "" : "es");
    out.push_back(text + cause);
  }
  return out;
}

std::vector<std::string> beyondPriorTexts(const Calibration& calibration) {
  std::vector<std::pair<double, std::string>> found;  // by how many deviations of the prior
  for (const CalibratedValue& value : calibration.values) {
    const auto prior = priorDeviation(value.key);
    const auto base = writtenBase(calibration, value.key);
    if (!prior || !base || !(*base > 0.0) || !(value.value > 0.0)) continue;
    const double times = writtenValue(value).value / *base;
    const double deviations = std::abs(std::log(times)) / *prior;
    if (deviations <= normal95) continue;
    char text[160];
    std::snprintf(text, sizeof text,
                  " is %.2g times that of the base model, more than its prior "
                  "allows (%.2g to %.2g).",
                  times, std::exp(-normal95 * *prior), std::exp(normal95 * *prior));
    found.emplace_back(deviations, value.key + text);
  }
  std::ranges::sort(found, std::greater<>());
  std::vector<std::string> out;
  for (auto& one : found) out.push_back(std::move(one.second));
  return out;
}

std::string samplesText(const CalibratedValue& value) {
  std::string of = value.of;
  if (value.samples == 1) {
    // The first word is in the plural: "times the ball left or entered the view".
    const std::size_t end = std::min(of.find(' '), of.size());
    if (end > 0 && of[end - 1] == 's') of.erase(end - 1, 1);
  }
  return std::to_string(value.samples) + ' ' + of;
}

const CalibratedValue* Calibration::find(std::string_view key) const {
  const auto found = std::ranges::find(values, key, &CalibratedValue::key);
  return found == values.end() ? nullptr : &*found;
}

void take(Calibration& out, CalibratedValue value) {
  const auto set = [&](const auto& parameters, auto& numbers, const std::string& key) {
    for (const auto& parameter : parameters) {
      if (key != parameter.key) continue;
      const double least = parameter.stored(parameter.least);
      const double most = parameter.stored(parameter.most);
      for (double* one : {&value.value, &value.low, &value.high}) {
        *one = std::clamp(*one, least, most);
      }
      numbers.*parameter.member = value.value;
    }
  };
  if (value.key.starts_with("noise.")) {
    set(sim::noiseParameters, out.model.noise, value.key.substr(6));
  } else {
    set(sim::robotModelParameters, out.model, value.key);
  }
  out.values.push_back(std::move(value));
}

std::vector<std::string> calibrationKeys() {
  std::vector<std::string> keys;
  for (const MotionParameter& parameter : motionParameters) keys.emplace_back(parameter.key);
  keys.insert(keys.end(), furtherKeys().begin(), furtherKeys().end());
  return keys;
}

Result<Calibration> calibrate(std::span<const CalibrationLog> logs, const sim::RobotModel& base,
                              const CalibrationOptions& options,
                              const CalibrationProgress& progress) {
  if (logs.empty()) return failure(ErrorCode::InvalidArgument, "no recording was given");
  if (!(options.holdOut >= 0.0 && options.holdOut <= 0.5)) {
    return failure(ErrorCode::InvalidArgument, "the held-out share must be 0 to 0.5");
  }
  Calibration out;
  out.robot = logs.front().robot;
  out.base = base;
  out.model = base;
  std::vector<CalibrationLog> fitted;
  for (const CalibrationLog& log : logs) {
    if (log.rows.size() < 2) {
      return failure(ErrorCode::InvalidArgument, "the recording has no rows", log.session);
    }
    out.sessions.push_back(log.session);
    out.notes.insert(out.notes.end(), log.notes.begin(), log.notes.end());
    out.seconds += log.rows.back().time - log.rows.front().time;
    fitted.push_back(firstPart(log, options.holdOut));
    if (fitted.back().rows.size() < 2) fitted.back() = log;
  }
  std::vector<MotionFilter> filters;
  filters.reserve(fitted.size());
  for (const CalibrationLog& log : fitted) filters.emplace_back(log, base);
  const auto part = [&](double done) { return !progress || progress(0.9 * done); };
  const MotionFit motion = fitMotion(filters, fitted, base, part);
  if (motion.ofLogs.empty()) return failure(ErrorCode::Conflict, "the calibration was cancelled");

  addMotion(motion, countsOf(filters, fitted), out);
  reportTimes(motion, out);
  reportSpreads(filters, fitted, motion, out);
  fitPercepts(filters, fitted, motion, out);
  fitKicks(filters, fitted, motion, out);
  reportLeftOut(filters, fitted, motion, out);
  for (const char* key : hiddenKeys()) out.kept[key] = "a recording does not contain it";
  if (out.values.empty()) {
    return failure(ErrorCode::NotFound,
                   "nothing could be estimated: the recording has too little of robot " +
                       out.robot + " in motion");
  }
  out.model.name = out.robot + "-calibrated";
  checkPredictions(logs, options.holdOut, motion, out);
  describeResiduals(motion, out);
  const std::vector<std::string> beyond = beyondPriorTexts(out);
  out.notes.insert(out.notes.end(), beyond.begin(), beyond.end());
  if (progress) progress(1.0);
  return out;
}

}  // namespace pitchboard::link
