// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <vector>

#include <app/command_line.h>
#include <app/usage.h>
#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/live/live_teams.h>
#include <robotlink/match/match_runner.h>
#include <telemetry/session/session_time.h>

namespace pitchboard::studio {
namespace {

constexpr int maxPixels = 16384;

void addOptions(CLI::App& app, Arguments& a) {
  a.match.scenario = "kick-off";  // robots move from the beginning
  shared::addScenarioOptions(app, a.match);
  app.add_option("--cognition", a.cognition,
                 "Where the robots' processes run: separate processes on System V blackboards "
                 "(separate), inside the studio (inline), or only your own programs (none)")
      ->type_name("separate|inline|none")
      ->capture_default_str()
      ->check(CLI::IsMember({"separate", "inline", "none"}))
      // The name up to version 0.14.
      ->transform([](const std::string& text) { return text == "external" ? "separate" : text; });
  app.add_option("--speed", a.speed, "Speed, 0.01 to 1000 times real time, or max")
      ->type_name("X|max")
      ->capture_default_str();
  shared::addRobotsOptions(app, a.processes);
  app.add_option("--theme", a.theme, "Colour theme for this run")
      ->type_name("light|dark")
      ->check(CLI::IsMember({"light", "dark"}));
  app.add_flag("--paused", a.paused, "Start paused");
  app.add_option("--play-to", a.playTo,
                 "Play at full speed up to this tick, then pause: the same moment every time")
      ->type_name("TICK");
  app.add_option("--size", a.size, "Size of the window or the picture")->type_name("WxH");
  app.add_option("--settings", a.settings,
                 "File for layout and preferences instead of the user's own")
      ->type_name("FILE");
  app.add_option("--session", a.session, "Open this recording in Replay")->type_name("FILE.mcap");
  app.add_option("--at", a.at, "Start Replay at this time: 78.7, 1:18.7 or 0:01:18.7")
      ->type_name("T");
  app.add_option("file", a.file,
                 "A recording to replay, or a scenario (FILE.json) to play. A recording alone is "
                 "opened in the running studio, if there is one")
      ->type_name("FILE");
  app.add_flag("--new-window")
      ->description("Open the recording in a new studio even if one is running");
  app.add_option("--record", a.record,
                 "Record a match or live robots from the start into this new file; an existing "
                 "file is kept, and the new one gets a number")
      ->type_name("FILE.mcap");
  app.add_flag("--live", a.live, "Start in Live; no match is simulated unless --scenario is given");
  app.add_flag("--overlay", a.overlay, "Overlay live robots on simulated ones");
  app.add_option("--bind", a.bind, "Live: address to receive at")->type_name("ADDRESS");
  app.add_option("--port-base", a.portBase, "Live: robot n sends to port base + n")->type_name("P");
  app.add_option("--variables-port-base", a.variablesPortBase,
                 "Live: robot n sends variables to this port base + n; 0: off")
      ->type_name("P");
  app.add_option("--robots", a.robots, "Live: number of ports after the base")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  app.add_option("--gamecontroller-port", a.refereePort, "Live: port of the referee's packets")
      ->type_name("P");
  app.add_option("--our-team", a.ourTeam,
                 "Live: our team, by the referee's number or its colour, such as blue or red")
      ->type_name("N|COLOUR");
  app.add_option("--profile", a.profile,
                 "Live: message profile: a file, or a name that docs/live.md lists")
      ->type_name("FILE|NAME");
  app.add_option("--team", a.teams, "Live: team setup as JSON; may be repeated")->type_name("FILE");
  app.add_option("--attach", a.attached,
                 "Live: attach the blackboard with this System V key, read-only; may be repeated")
      ->type_name("KEY[,catalog=FILE][,size=BYTES][,robot=N][,rate=R][,team=COLOUR]");
  CLI::Option* shot =
      app.add_option("--screenshot-to", a.screenshotFile, "Save a picture of the window, then exit")
          ->type_name("FILE.png");
  app.add_option("--after", a.after, "When to take the picture")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 86400.0))
      ->needs(shot);
  CLI::Option* render = app.add_option("--render-scenario", a.renderScenario,
                                       "Draw a scenario's start to --picture, without a window")
                            ->type_name("NAME|FILE");
  CLI::Option* paint =
      app.add_option("--paint", a.paint,
                     "Paint the field at --from of this session, or a video from --from until "
                     "--until, to --picture, without a window")
          ->type_name("FILE.mcap")
          ->excludes(render);
  app.add_option("--picture", a.picture,
                 "Where --render-scenario and --paint write: .png or .svg; --paint: also .mp4 or "
                 ".webm")
      ->type_name("FILE");
  app.add_option("--from", a.from, std::string("Time in the recording: ") + timeForms)
      ->type_name("T")
      ->needs(paint);
  app.add_option("--until", a.until, "End of a video; same format as --from")
      ->type_name("T")
      ->needs(paint);
  app.add_option("--rate", a.rate, "Frames per second of a video")
      ->type_name("N")
      ->capture_default_str()
      ->needs(paint);
  app.add_option("--only", a.paintRobots, "Paint only these robots, e.g. B1,R2")
      ->type_name("NAMES")
      ->delimiter(',')
      ->needs(paint);
  shared::addGroup(app, "Live",
                   {"--bind", "--port-base", "--variables-port-base", "--robots",
                    "--gamecontroller-port", "--our-team", "--profile", "--team", "--attach"});
  shared::addGroup(app, "Pictures and videos",
                   {"--screenshot-to", "--after", "--play-to", "--size", "--render-scenario",
                    "--paint", "--picture", "--from", "--until", "--rate", "--only"});
  shared::addGroup(app, "Window", {"--theme", "--settings", "--new-window"});
}

/// A file named without an option is a scenario when it ends in .json, else a session. False when
/// the option that it stands for is given, too.
bool takeFile(const CLI::App& app, Arguments& a) {
  if (a.file.empty()) return true;
  const bool scenario = a.file.ends_with(".json");
  if (app.count(scenario ? "--scenario" : "--session") > 0) return false;
  (scenario ? a.match.scenario : a.session) = a.file;
  return true;
}

/// No other options than these are on the command line.
bool onlyGiven(const CLI::App& app, const std::vector<std::string>& names) {
  const auto given = app.get_options([](const CLI::Option* option) { return option->count() > 0; });
  return std::all_of(given.begin(), given.end(), [&](const CLI::Option* option) {
    return std::any_of(names.begin(), names.end(),
                       [option](const std::string& name) { return option->check_name(name); });
  });
}

}  // namespace

std::optional<int> parseArguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app{
      "Pitchboard: simulate humanoid soccer robots, watch real ones, and see what they believe.\n"
      "Examples: pitchboard --scenario match-3v3 --noise realistic --speed 2\n"
      "          pitchboard --live --our-team 12 --record semifinal.mcap"};
  app.name("pitchboard");
  app.set_version_flag("--version", PITCHBOARD_VERSION, "Print the version");
  addOptions(app, arguments);
  if (const auto ended = shared::parse(app, argc, argv)) return ended;
  if (!takeFile(app, arguments)) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "two files to open are given, one by its option and " +
                                    arguments.file + " without. Leave out one of them",
                                {}});
  }
  arguments.scenarioGiven = app.count("--scenario") > 0 || arguments.file.ends_with(".json");
  arguments.onlySession =
      !arguments.session.empty() && onlyGiven(app, {"--session", "file", "--settings"});
  const bool paints = !arguments.renderScenario.empty() || !arguments.paint.empty();
  if (paints == arguments.picture.empty()) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "--render-scenario and --paint need --picture FILE to write to, "
                                "and --picture needs one of them",
                                {}});
  }
  if (!arguments.at.empty() && arguments.session.empty()) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "--at is a time in a recording: name the recording, too, such as "
                                "match.mcap --at 1:18.7",
                                {}});
  }
  if (!arguments.record.empty() && !arguments.session.empty()) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "--record records a match or live robots, and " +
                                    arguments.session +
                                    " is a recording already. Leave out one of them",
                                {}});
  }
  if (!arguments.record.empty() && !arguments.renderScenario.empty()) {
    return shared::reportError({ErrorCode::InvalidArgument,
                                "--record needs a match that is played, but --render-scenario only "
                                "draws one. Leave out one of them",
                                {}});
  }
  return {};
}

Result<std::optional<double>> timeIn(const telemetry::SessionReader& session,
                                     const std::string& text, const char* option) {
  if (text.empty()) return std::optional<double>{};
  const auto range = session.range();
  if (!range) return failure(ErrorCode::InvalidArgument, "the recording is empty", option);
  const auto time = telemetry::sessionTime(text, session.info().start, *range);
  if (!time) return failure(time.error().code, time.error().message, option);
  return std::optional(*time);
}

Result<std::optional<double>> startOf(const Arguments& arguments) {
  if (arguments.at.empty()) return std::optional<double>{};
  return timeIn(TRY(telemetry::SessionReader::open(arguments.session)), arguments.at, "--at");
}

Result<std::optional<WindowSize>> sizeOf(const Arguments& arguments) {
  if (arguments.size.empty()) return std::optional<WindowSize>{};
  WindowSize size;
  char rest = 0;
  if (std::sscanf(arguments.size.c_str(), "%6dx%6d%c", &size.width, &size.height, &rest) != 2 ||
      size.width < 100 || size.height < 100 || size.width > maxPixels || size.height > maxPixels) {
    return failure(ErrorCode::InvalidArgument,
                   "must be two numbers of pixels such as 1440x900 (100 to 16384), not '" +
                       arguments.size + "'",
                   "--size");
  }
  return size;
}

Result<link::Scenario> scenarioOf(const Arguments& arguments) {
  shared::ScenarioOptions match = arguments.match;
  if (!arguments.renderScenario.empty()) match.scenario = arguments.renderScenario;
  auto scenario = shared::scenarioFrom(match);
  if (scenario) scenario = shared::withRuntimes(std::move(*scenario), arguments.processes);
  if (!scenario) return scenario;
  // Asks the engine itself whether it can play this, before a window is opened.
  if (const auto trial = sim::Simulation::create(scenario->settings); !trial) {
    return tl::unexpected<Error>(trial.error());
  }
  return scenario;
}

Result<link::LiveOptions> liveOptionsOf(const Arguments& arguments, link::LiveOptions saved) {
  if (!arguments.bind.empty()) {
    const auto address = telemetry::parseAddress(arguments.bind);
    if (!address) return tl::unexpected<Error>(address.error());
    saved.bind = *address;
  }
  saved.portBase = arguments.portBase.value_or(saved.portBase);
  saved.variablesPortBase = arguments.variablesPortBase.value_or(saved.variablesPortBase);
  saved.robots = arguments.robots.value_or(saved.robots);
  saved.refereePort = arguments.refereePort.value_or(saved.refereePort);
  if (!arguments.ourTeam.empty()) {
    if (const auto ours = link::chooseOurTeam(saved, arguments.ourTeam); !ours) {
      return tl::unexpected<Error>(ours.error());
    }
  }
  if (!arguments.profile.empty()) {
    auto profile = telemetry::loadProfile(arguments.profile);
    if (!profile) return tl::unexpected<Error>(profile.error());
    saved.profile = std::move(*profile);
  }
  for (const std::string& text : arguments.attached) {
    auto board = link::parseAttachedBoard(text);
    if (!board) return tl::unexpected<Error>(board.error());
    std::erase_if(saved.boards, [&board](const auto& known) { return known.key == board->key; });
    saved.boards.push_back(std::move(*board));
  }
  for (std::size_t i = 0; i < arguments.teams.size(); ++i) {
    auto team = telemetry::loadTeamSetup(arguments.teams[i]);
    if (!team) return tl::unexpected<Error>(team.error());
    if (i == 0) saved.team.teams.clear();  // in place of those that are saved
    saved.team.teams.push_back(std::move(*team));
  }
  if (const auto good = link::validate(saved); !good) return tl::unexpected<Error>(good.error());
  return saved;
}

link::Cognition cognitionOf(const Arguments& arguments) {
  if (arguments.cognition == "inline") return link::Cognition::Inline;
  if (arguments.cognition == "none") return link::Cognition::None;
  return link::Cognition::Separate;
}

}  // namespace pitchboard::studio
