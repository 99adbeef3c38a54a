// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/calibrate/calibration_file.h>
#include <robotlink/models/robot_models.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

struct CalibrateOptions {
  std::vector<std::string> sessions;
  std::string robot, output, base = "kid-size", report, from, to;
  double holdOut = 0.2;
  bool json = false, force = false, progress = false;
};

Result<double> secondsOr(const std::string& text, const char* option, double fallback) {
  if (text.empty()) return fallback;
  const auto seconds = secondsFromText(text);
  if (!seconds) {
    return failure(ErrorCode::InvalidArgument,
                   std::string(option) + " must be a time such as 78.7 or 1:18.7");
  }
  return *seconds;
}

void printCalibration(const link::Calibration& calibration) {
  std::vector<std::array<std::string, 5>> rows{{"", "value", "95 % interval", "unit", "from"}};
  for (const auto* values : {&calibration.values, &calibration.estimates}) {
    for (const link::CalibratedValue& value : *values) {
      const link::WrittenValue w = link::writtenValue(value);
      char number[32], interval[64];
      std::snprintf(number, sizeof number, "%.4g", w.value);
      std::snprintf(interval, sizeof interval, "%.4g to %.4g", w.low, w.high);
      rows.push_back({value.key, number, interval, w.unit, link::samplesText(value)});
    }
  }
  std::array<std::size_t, 5> widths{};
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    std::printf("%s  %*s  %s  %s  %s\n", padded(row[0], widths[0]).c_str(),
                static_cast<int>(widths[1]), row[1].c_str(), padded(row[2], widths[2]).c_str(),
                padded(row[3], widths[3]).c_str(), row[4].c_str());
  }
  std::printf("\nNot estimated; the number of %s is kept:\n", calibration.base.name.c_str());
  for (const auto& [key, reason] : calibration.kept) {
    std::printf("%-28s %s\n", key.c_str(), reason.c_str());
  }
  for (const std::string& text : link::leftOutTexts(calibration)) std::printf("%s\n", text.c_str());
  for (const std::string& note : calibration.notes) std::printf("%s\n", note.c_str());
  if (calibration.check.windows.empty()) return;
  std::printf("Position after 5 s: %.1f cm off, with %s %.1f cm (%zu windows)\n",
              100.0 * calibration.check.rms, calibration.base.name.c_str(),
              100.0 * calibration.check.rmsBase, calibration.check.windows.size());
}

Result<int> calibrateRobot(const CalibrateOptions& options) {
  const InterruptGuard signals;
  Progress progress("calibrating", options.progress);
  const auto base = TRY(link::loadRobotModel(options.base));
  const telemetry::TimeRange range{TRY(secondsOr(options.from, "--from", -1e18)),
                                   TRY(secondsOr(options.to, "--to", 1e18))};
  const IfExists oldModel = TRY(ifExists(options.output, options.force));
  const IfExists oldReport = TRY(ifExists(options.report, options.force));
  std::vector<link::CalibrationLog> logs;
  for (const std::string& path : options.sessions) {
    const auto session = TRY(telemetry::SessionReader::open(path));
    const std::string name = std::filesystem::path(path).filename();
    logs.push_back(TRY(link::readCalibrationLog(session, name, options.robot, range)));
  }
  const auto calibration = link::calibrate(logs, base, {options.holdOut}, std::ref(progress));
  if (!calibration && calibration.error().code == ErrorCode::NotFound) {
    std::fprintf(stderr, "%s%s\n", progress.fresh().c_str(), calibration.error().text().c_str());
    return 1;
  }
  if (!calibration) return tl::unexpected(calibration.error());
  TRY(link::writeCalibration(options.output, *calibration, programName, oldModel));
  if (!options.report.empty()) {
    TRY(writeFile(options.report, link::calibrationReport(*calibration, logs.front().field),
                  oldReport));
  }
  if (options.json) {
    std::printf("%s", link::calibrationToJson(*calibration, programName).c_str());
  } else {
    printCalibration(*calibration);
  }
  return 0;
}

}  // namespace

void addCalibrateCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = parent.add_subcommand(
      "calibrate",
      "Estimate a robot model from recordings of it. The model has speeds, times, noise, camera "
      "and "
      "kicks. Exits with 1 if nothing can be estimated.\n"
      "Example: pitchboard-cli calibrate training.mcap --robot B1 -o robot.json --report "
      "robot.html");
  command->add_option("session", options->sessions, "The recordings")
      ->required()
      ->type_name("SESSION");
  command->add_option("--robot", options->robot, "The robot, as the recording names it: B1")
      ->required()
      ->type_name("ROBOT");
  command->add_option("-o,--output", options->output, "Write the robot model here")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--base", options->base,
                   "Robot model that the estimates start from: a name or a file")
      ->capture_default_str()
      ->type_name("MODEL");
  command->add_option("--report", options->report, "Write a report with plots here")
      ->type_name("FILE.html");
  command->add_option("--from", options->from, "Use the recordings from this time on")
      ->type_name("T");
  command->add_option("--to", options->to, "Use the recordings up to this time")->type_name("T");
  command
      ->add_option("--hold-out", options->holdOut,
                   "Share at the end of each recording that is predicted instead of fitted")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  addForce(*command, options->force, "Replace existing files");
  command->add_flag("--json", options->json, "Print the robot model with its intervals as JSON");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, calibrateRobot);
}

}  // namespace pitchboard::cli
