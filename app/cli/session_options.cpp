// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_options.h"

#include <telemetry/session/session_time.h>

namespace pitchboard::cli {

using namespace telemetry;

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

void addRobots(CLI::App& command, std::vector<std::string>& robots, const char* description) {
  command.add_option("--robots", robots, description)->type_name("NAMES")->delimiter(',');
}

void addVariables(CLI::App& command, std::vector<std::string>& variables, const char* description) {
  command.add_option("--variables", variables, description)->type_name("NAMES")->delimiter(',');
}

}  // namespace pitchboard::cli
