// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio's command line. No Qt: it is read before there is an application.

#include <optional>
#include <string>
#include <vector>

#include <app/robots_options.h>
#include <app/scenario_options.h>
#include <robotlink/live/live_watch.h>
#include <robotlink/match/simulated_match.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::studio {

struct WindowSize {
  int width = 0;
  int height = 0;
};

struct Arguments {
  shared::ScenarioOptions match;
  std::string cognition = "separate";
  std::string speed = "1";
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
  double rate = 10.0;                    ///< pictures a second of a video
  std::vector<std::string> paintRobots;  ///< only these; empty: all
  std::string settings;
  std::string file;          ///< named without an option: a session or a scenario to open
  std::string session;       ///< a recorded session to open in Replay
  std::string at;            ///< where Replay starts; empty: at the beginning
  bool onlySession = false;  ///< nothing else was asked for: a studio that runs can open it
  std::string record;        ///< session file to record into from the first moment; empty: none
  bool live = false;
  bool overlay = false;
  bool scenarioGiven = false;  ///< else Live starts without a simulated match
  // Of Live, instead of the saved settings; empty: as saved.
  std::string bind;
  std::optional<int> portBase, variablesPortBase, robots, refereePort;
  std::string ourTeam;
  std::string profile;
  std::vector<std::string> teams;     ///< team setups
  std::vector<std::string> attached;  ///< blackboards: KEY[,catalog=FILE][,size=BYTES][,robot=N]
};

/// Fills `arguments`; returns an exit code when the program is to end here (help, bad usage).
std::optional<int> parseArguments(int argc, char** argv, Arguments& arguments);

/// Nothing when no size was given.
Result<std::optional<WindowSize>> sizeOf(const Arguments& arguments);
/// The scenario with seed, noise and physics of the command line in it.
Result<link::Scenario> scenarioOf(const Arguments& arguments);
link::Cognition cognitionOf(const Arguments& arguments);
/// Second of the session at which Replay starts, where one is given. Reads the session.
Result<std::optional<double>> startOf(const Arguments& arguments);
/// The second that is meant by `text`, the value of this option; nothing when it is empty.
Result<std::optional<double>> timeIn(const telemetry::SessionReader& session,
                                     const std::string& text, const char* option);

/// The saved options of Live with those of the command line in them.
Result<link::LiveOptions> liveOptionsOf(const Arguments& arguments, link::LiveOptions saved);

}  // namespace pitchboard::studio
