// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_options.h"

#include <cstdio>
#include <filesystem>

#include <base/try.h>
#include <telemetry/session/recording_files.h>
#include <telemetry/session/session_time.h>

namespace pitchboard::cli {

using namespace telemetry;
namespace fs = std::filesystem;

void addPart(CLI::App& command, PartOptions& options, const std::string& clockNote) {
  command.add_option("--from", options.from, std::string("Start: ") + sessionTimeForms)
      ->type_name("T");
  command.add_option("--until", options.until, "End; same format as --from")->type_name("T");
  command.add_flag("--clock", options.clock,
                   "Read --from and --until as local times of day" + clockNote);
}

Result<Part> partOf(const SessionReader& session, const PartOptions& options) {
  Part part;
  const auto range = session.range();
  if (!range && (!options.from.empty() || !options.until.empty())) {
    return failure(ErrorCode::InvalidArgument,
                   "The recording is empty, so --from and --until cannot be used.");
  }
  const auto read = [&](const char* option, const std::string& text,
                        std::optional<double>& to) -> Result<void> {
    if (text.empty()) return {};
    auto time = sessionTime(text, session.info().start, *range,
                            options.clock ? TimeForms::Clock : TimeForms::Session, part.from);
    if (!time) return failure(time.error().code, option + (": " + time.error().message));
    to = *time;
    return {};
  };
  if (auto from = read("--from", options.from, part.from); !from) {
    return tl::unexpected(from.error());
  }
  // From 23:59 until 00:01 is two minutes.
  if (auto until = read("--until", options.until, part.until); !until) {
    return tl::unexpected(until.error());
  }
  return part;
}

void addReading(CLI::App& command, int& jobs, bool& progress) {
  command
      .add_option("--jobs", jobs,
                  "How many threads read; default: one for each core of the computer")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  command.add_flag("--progress", progress, "Print progress to stderr even if it is not a terminal");
}

void addRobots(CLI::App& command, std::vector<std::string>& robots, const char* description) {
  command.add_option("--robots", robots, description)->type_name("NAMES")->delimiter(',');
}

void addVariables(CLI::App& command, std::vector<std::string>& variables, const char* description) {
  command.add_option("--variables", variables, description)->type_name("NAMES")->delimiter(',');
}

Result<std::vector<std::string>> recordingsOf(const std::vector<std::string>& places) {
  std::vector<std::string> out;
  for (const std::string& place : places) {
    std::error_code unknown;
    if (!fs::is_directory(place, unknown)) {
      out.push_back(place);
      continue;
    }
    const std::vector<std::string> found = TRY(recordingsIn(place));
    if (found.empty()) {
      return failure(ErrorCode::NotFound, "This folder has no recordings (*.mcap).", place);
    }
    out.insert(out.end(), found.begin(), found.end());
  }
  return out;
}

bool reportReading(const std::string& file, const FileMoments& found, const std::string& fresh) {
  if (found.isForeign) {
    std::fprintf(stderr,
                 "%swarning: %s: another program recorded this file; make a session of it with "
                 "pitchboard-cli import.\n",
                 fresh.c_str(), file.c_str());
    return true;
  }
  if (found.error && found.unanswered.empty()) {
    (void)std::fputs(fresh.c_str(), stderr);
    // Errors of a file begin with its name.
    Error error = *found.error;
    if (!error.context.starts_with(file)) {
      error.context = error.context.empty() ? file : file + " " + error.context;
    }
    (void)reportError(error);
    return false;
  }
  for (const std::string& note : found.notes) {
    std::fprintf(stderr, "%swarning: %s: %s\n", fresh.c_str(), file.c_str(), note.c_str());
  }
  return !found.isDamaged;
}

}  // namespace pitchboard::cli
