// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Estimates a robot model from recordings (docs/calibrate.md). For each number of the model that
// commands, IMU and percepts give information about, it computes a posterior, with a prior around a
// base model. The true poses in simulated recordings are never used. SI units, radians. Takes
// seconds to minutes, so call it on a thread of its own. Pure apart from the progress function.

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
  std::string
      key;  ///< as in robot files ("turn", "noise.imu_white"), or of the field ("field....")
  double value = 0.0, low = 0.0, high = 0.0;  ///< median of the posterior; m, s, rad
  std::size_t samples = 0;
  std::string of;  ///< what `samples` counts, in the plural: "actions", "percepts"
};

/// "950 percepts", "1 action".
std::string samplesText(const CalibratedValue& value);

/// A window of the recording, and the motion predicted from its start.
struct PredictedWindow {
  std::size_t session = 0;  ///< position of its recording
  double time = 0.0;        ///< s, start of the window
  struct Place {
    double time = 0.0;
    Point recorded;    ///< estimated from the recording with the calibrated model
    Point calibrated;  ///< predicted from the commands alone with the calibrated model
    Point base;        ///< predicted from the commands alone with the base model
  };
  std::vector<Place> places;  ///< every 0.1 s
};

struct CalibrationCheck {
  double window = 5.0;              ///< s
  double rms = 0.0, rmsBase = 0.0;  ///< m, at the end of the windows
  std::vector<PredictedWindow> windows;
};

/// Normalized innovations of a sensor.
struct CalibrationResiduals {
  std::string sense;
  std::size_t count = 0;
  double mean = 0.0, deviation = 0.0;  ///< 0 and 1 for a correct model; the mean is the bias
  double autocorrelation = 0.0;        ///< of successive values; 0 for a correct model
  std::vector<double> overTime;        ///< root mean square in equal parts of the time
  std::vector<double> quantiles;       ///< at the normal distribution's -2, -1.5, ... 2
};

/// "120 measurements, bias 0.02, deviation 1.01, autocorrelation 0.03".
std::string residualsText(const CalibrationResiduals& residuals);

/// What of the recordings was not used, for one reason.
struct LeftOut {
  double seconds = 0.0;
  std::size_t stretches = 0;
};

struct Calibration {
  std::string robot;
  sim::RobotModel base;   ///< medians of the prior
  sim::RobotModel model;  ///< the base model with the estimated numbers
  std::vector<CalibratedValue> values;
  std::map<std::string, std::string> kept;  ///< keys that were not estimated, with the reason
  /// Results that are not part of a model: time to reach and leave a speed, spread between actions.
  std::vector<CalibratedValue> estimates;
  std::map<std::string, LeftOut> leftOut;  ///< by reason
  std::vector<std::string> sessions;
  std::vector<std::string> notes;
  double seconds = 0.0;  ///< total duration of the recordings
  CalibrationCheck check;
  std::vector<CalibrationResiduals> residuals;
  const CalibratedValue* find(std::string_view key) const;
};

struct CalibrationOptions {
  /// Share at the end of each recording that is used to check predictions, not to fit; 0 to 0.5.
  double holdOut = 0.2;
};

/// "Left out: 12.3 s in 4 stretches, beside the ball", for each reason.
std::vector<std::string> leftOutTexts(const Calibration& calibration);

/// Returns a sentence for each estimated number that lies outside of the 95 % interval of its
/// prior, the farthest first: the recording shows something else, or the base model is another
/// robot's.
std::vector<std::string> beyondPriorTexts(const Calibration& calibration);

/// Called with the progress, 0 to 1; return false to cancel.
using CalibrationProgress = std::function<bool(double)>;

/// Estimates the model. All logs must be of the same robot. Fails with InvalidArgument if there is
/// no log or an option is out of range, with NotFound if nothing could be estimated, and with
/// Conflict if `progress` cancelled it.
Result<Calibration> calibrate(std::span<const CalibrationLog> logs, const sim::RobotModel& base,
                              const CalibrationOptions& options = {},
                              const CalibrationProgress& progress = {});

/// Returns all keys that calibrate() can estimate, in the order of robot files.
std::vector<std::string> calibrationKeys();

}  // namespace pitchboard::link
