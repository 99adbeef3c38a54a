// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The command line of the studio. It needs no Qt, because it is parsed before the application
// exists. Main thread.

#include <optional>
#include <string>
#include <vector>

#include <app/robots_options.h>
#include <app/scenario_options.h>
#include <robotlink/live/live_options.h>
#include <robotlink/match/simulated_match.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::studio {

struct WindowSize {
  int width = 0;
  int height = 0;
};

struct Arguments {
  shared::ScenarioOptions match;
  shared::RobotsOptions processes;
  std::string theme;
  bool paused = false;
  std::optional<std::uint64_t> playTo;
  std::string screenshotFile;
  double after = 2.0;
  std::string size;
  std::string renderScenario;
  std::string paint;  ///< session to paint into `picture`
  std::string picture;
  std::string from, until;               ///< times of the session
  double rate = 10.0;                    ///< pictures per second of a video
  std::vector<std::string> paintRobots;  ///< only these; empty: all
  std::string settings;
  std::string file;     ///< argument without an option: a session or a scenario to open
  std::string session;  ///< a recorded session to open in Replay
  std::string at;       ///< where Replay starts; empty: at the beginning
  bool newWindow = false;
  bool onlySession = false;  ///< no other option was given, so a running studio can open it
  std::string record;        ///< session file to record into from the first moment; empty: none
  bool live = false;
  bool overlay = false;
  bool scenarioGiven = false;  ///< if false, Live starts without a simulated match
  OptionValues liveOptions;    ///< those of Live that replace the saved ones, by name
};

/// Parses the command line into `arguments`. Returns an exit code if the program has to end now
/// (help, or an invalid option).
std::optional<int> parseArguments(int argc, char** argv, Arguments& arguments);

/// Returns the window size; empty if none was given.
Result<std::optional<WindowSize>> sizeOf(const Arguments& arguments);
/// Returns the scenario with the seed, noise and physics of the command line.
Result<link::Scenario> scenarioOf(const Arguments& arguments);
/// Returns the second of the session at which Replay starts; empty if none was given. Reads the
/// session.
Result<std::optional<double>> startOf(const Arguments& arguments);
/// Converts `text`, the value of this option, to a second of the session; empty if `text` is empty.
Result<std::optional<double>> timeIn(const telemetry::SessionReader& session,
                                     const std::string& text, const char* option);

/// Returns the saved options of Live, changed by those of the command line.
Result<link::LiveOptions> liveOptionsOf(const Arguments& arguments, link::LiveOptions saved);

}  // namespace pitchboard::studio
