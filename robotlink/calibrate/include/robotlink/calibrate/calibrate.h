// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Estimates a robot model from recordings: a posterior for every number that commands, IMU and
// percepts tell something about, with a prior around a base model (docs/calibrate.md). Truth that a
// simulated recording holds is never used. SI units, radians. Takes seconds to minutes; call it on
// a thread of its own. Pure apart from the progress function.

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/calibrate/calibration_log.h>
#include <simcore/world/robot_model.h>

namespace pitchboard::link {

/// One number with its 95 % interval (central, of the posterior).
struct CalibratedValue {
  std::string key;  ///< as in robot files: "turn", "noise.imu_white"; "field.rolling_deceleration"
  double value = 0.0, low = 0.0, high = 0.0;  ///< median of the posterior; m, s, rad
  std::size_t samples = 0;
  std::string of;  ///< what was counted: "stints", "percepts"
};

/// A moment of the recording and what was predicted from it.
struct PredictedWindow {
  std::size_t session = 0;  ///< position of its recording
  double time = 0.0;        ///< s, of its start
  struct Place {
    double time = 0.0;
    Point recorded;    ///< as the filter of the calibrated model found it
    Point calibrated;  ///< predicted from the commands alone
    Point base;
  };
  std::vector<Place> places;  ///< every 0.1 s
};

struct CalibrationCheck {
  double window = 5.0;              ///< s
  double rms = 0.0, rmsBase = 0.0;  ///< m, at the end of the windows
  std::vector<PredictedWindow> windows;
};

/// Normalized innovations of one sense.
struct CalibrationResiduals {
  std::string sense;
  std::size_t count = 0;
  double mean = 0.0, deviation = 0.0;  ///< 0 and 1 where the model is right
  double autocorrelation = 0.0;        ///< of neighbours; 0 where the model is right
  std::vector<double> overTime;        ///< root mean square in equal parts of the time
  std::vector<double> quantiles;       ///< at the normal's -2, -1.5, ... 2
};

struct Calibration {
  std::string robot;
  sim::RobotModel base;   ///< the prior's medians
  sim::RobotModel model;  ///< with what was estimated
  std::vector<CalibratedValue> values;
  std::map<std::string, std::string> kept;  ///< key: why it keeps the base model's number
  /// Not numbers of a model: seconds to reach and to leave a speed, spread between stints.
  std::vector<CalibratedValue> told;
  std::map<std::string, double> leftOut;  ///< s by cause
  std::vector<std::string> sessions;
  std::vector<std::string> notes;
  double seconds = 0.0;  ///< of recordings
  CalibrationCheck check;
  std::vector<CalibrationResiduals> residuals;
  const CalibratedValue* find(std::string_view key) const;
};

struct CalibrationOptions {
  /// Share of every recording, at its end, that is not fitted but predicted; 0 to 0.5.
  double holdOut = 0.2;
};

/// Is told the part that is done, 0 to 1; false cancels.
using CalibrationProgress = std::function<bool(double)>;

/// All logs are of the same robot. Errors: InvalidArgument without a log or with options out of
/// their range, NotFound where nothing could be estimated, Cancelled.
Result<Calibration> calibrate(std::span<const CalibrationLog> logs, const sim::RobotModel& base,
                              const CalibrationOptions& options = {},
                              const CalibrationProgress& progress = {});

/// Every key that calibrate() knows, estimated or not, in the order of robot files.
std::vector<std::string> calibrationKeys();

}  // namespace pitchboard::link
