// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a calibration as a file and as a report. The file is a robot model that scenarios and
// programs can load; intervals, numbers of samples and reasons are under its key "calibration"
// (docs/calibrate.md). Pure functions, except for writing the file; any thread.

#include <optional>
#include <string>
#include <string_view>

#include <base/file_target.h>
#include <robotlink/calibrate/calibrate.h>

namespace pitchboard::link {

/// Returns the file as JSON, with angles in degrees as in every robot file. `program` is the name
/// and version of the writing program.
std::string calibrationToJson(const Calibration& calibration, std::string_view program);

/// A value in the units that people read: degrees for angles.
struct WrittenValue {
  double value = 0.0, low = 0.0, high = 0.0;
  std::string unit;  ///< "m/s"; empty for plain numbers
};
/// Converts a calibrated value to these units.
WrittenValue writtenValue(const CalibratedValue& value);
/// Returns the value of the base model for a key, in these units; empty for keys that are not in a
/// model.
std::optional<double> writtenBase(const Calibration& calibration, std::string_view key);

/// Returns the report as a self-contained HTML page: values, residuals, and predicted against
/// recorded motion.
std::string calibrationReport(const Calibration& calibration, const sim::FieldSpec& field);

/// Fails as writeFile() does.
Result<void> writeCalibration(const std::string& path, const Calibration& calibration,
                              std::string_view program, IfExists ifExists);

}  // namespace pitchboard::link
