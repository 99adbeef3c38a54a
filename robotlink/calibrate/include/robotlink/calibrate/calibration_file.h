// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A calibration as a file: a robot model that scenarios and programs load, with the intervals,
// samples and reasons under the key "calibration" (docs/calibrate.md); and as a report for a
// browser. Any thread.

#include <optional>
#include <string>
#include <string_view>

#include <base/file_target.h>
#include <robotlink/calibrate/calibrate.h>

namespace pitchboard::link {

/// JSON; angles in degrees, as in every robot file. `program`: name and version of who writes it.
std::string calibrationToJson(const Calibration& calibration, std::string_view program);

/// Numbers as people write them: degrees for angles.
struct WrittenValue {
  double value = 0.0, low = 0.0, high = 0.0;
  std::string unit;  ///< "m/s"; empty for plain numbers
};
WrittenValue writtenValue(const CalibratedValue& value);
/// The base model's number for a key, as people write it; nothing for what is not in a model.
std::optional<double> writtenBase(const Calibration& calibration, std::string_view key);

/// One HTML page that needs nothing but itself: values, residuals, predictions over what was
/// recorded.
std::string calibrationReport(const Calibration& calibration, const sim::FieldSpec& field);

/// Errors as writeFile().
Result<void> writeCalibration(const std::string& path, const Calibration& calibration,
                              std::string_view program, IfExists ifExists);

}  // namespace pitchboard::link
