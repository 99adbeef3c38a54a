// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

#include <app/command_line.h>
#include <app/option_arguments.h>
#include <app/usage.h>
#include <base/try.h>
#include <telemetry/session/session_time.h>

namespace pitchboard::studio {
namespace {

constexpr int maxPixels = 16384;

constexpr const char* leaveOut = "leave it out, or set QT_QPA_PLATFORM=offscreen";

template <auto member>
constexpr OptionAccess<Arguments> argument = optionMember<Arguments, member>;

std::vector<OptionChoice> themeChoices() {
  return {{std::string("light"), {}}, {std::string("dark"), {}}};
}

// clang-format off
constexpr Option<Arguments> argumentTable[] = {
    {{.name = "theme", .form = "light|dark", .text = "Colour theme for this run",
      .choices = themeChoices, .instead = leaveOut}, argument<&Arguments::theme>},
    {{.name = "paused", .text = "Start paused", .instead = leaveOut}, argument<&Arguments::paused>},
    {{.name = "play-to", .form = "TICK",
      .text = "Play at full speed up to this tick, then pause: the same moment every time",
      .instead = leaveOut}, argument<&Arguments::playTo>},
    {{.name = "size", .form = "WxH", .text = "Size of the window or the picture",
      .instead = leaveOut}, argument<&Arguments::size>},
    {{.name = "settings", .form = "FILE",
      .text = "File for layout and preferences instead of the user's own", .instead = leaveOut},
      argument<&Arguments::settings>},
    {{.name = "session", .form = "FILE.mcap", .text = "Open this recording in Replay"},
      argument<&Arguments::session>},
    {{.name = "at", .form = "T", .text = "Start Replay at this time: 78.7, 1:18.7 or 0:01:18.7",
      .instead = leaveOut}, argument<&Arguments::at>},
    {{.name = "new-window", .text = "Open the recording in a new studio even if one is running",
      .instead = leaveOut}, argument<&Arguments::newWindow>},
    {{.name = "record", .form = "FILE.mcap",
      .text = "Record a match or live robots from the start into this new file; an existing file "
              "is kept, and the new one gets a number",
      .instead = "pitchboard-cli record records without one"}, argument<&Arguments::record>},
    {{.name = "live", .text = "Start in Live; no match is simulated unless --scenario is given"},
      argument<&Arguments::live>},
    {{.name = "overlay", .text = "Overlay live robots on simulated ones"},
      argument<&Arguments::overlay>},
    {{.name = "screenshot-to", .form = "FILE.png",
      .text = "Save a picture of the window, then exit"}, argument<&Arguments::screenshotFile>},
    {{.name = "after", .form = "SECONDS", .text = "When to take the picture",
      .min = 0, .max = 86400}, argument<&Arguments::after>},
    {{.name = "render-scenario", .form = "NAME|FILE",
      .text = "Draw a scenario's start to --picture, without a window"},
      argument<&Arguments::renderScenario>},
    {{.name = "paint", .form = "FILE.mcap",
      .text = "Paint the field at --from of this session, or a video from --from until --until, "
              "to --picture, without a window"}, argument<&Arguments::paint>},
    {{.name = "picture", .form = "FILE",
      .text = "Where --render-scenario and --paint write: .png or .svg; --paint: also .mp4 or "
              ".webm"}, argument<&Arguments::picture>},
    {{.name = "from", .form = "T", .text = "Time in the recording: 78.7, 1:18.7 or 0:01:18.7"},
      argument<&Arguments::from>},
    {{.name = "until", .form = "T", .text = "End of a video; same format as --from"},
      argument<&Arguments::until>},
    {{.name = "rate", .form = "N", .text = "Frames per second of a video"},
      argument<&Arguments::rate>},
    {{.name = "only", .form = "NAMES", .text = "Paint only these robots, e.g. B1,R2"},
      argument<&Arguments::paintRobots>},
};
// clang-format on

/// Returns the options that need a window.
shared::WindowOptions addOptions(CLI::App& app, Arguments& a) {
  a.match.scenario = "kick-off";  // robots move from the beginning
  a.processes.cognition = "separate";
  a.processes.speed = "1";
  shared::addScenarioOptions(app, a.match);
  shared::addRobotsOptions(app, a.processes);
  shared::addOptions(app, argumentTable, a);
  app.add_option("file", a.file,
                 "A recording to replay, or a scenario (FILE.json) to play. A recording alone is "
                 "opened in the running studio, if there is one")
      ->type_name("FILE");
  shared::WindowOptions window;
  for (const Option<Arguments>& option : argumentTable) {
    if (option.info.instead == nullptr) continue;
    const std::string name = "--" + std::string(option.info.name);
    window[name] = name + " needs a window; " + option.info.instead;
  }
  const auto before = app.get_options();
  shared::addOptions(app, link::liveOptionTable(), link::LiveOptions(), a.liveOptions);
  for (CLI::Option* option : app.get_options()) {
    const bool isOfLive = std::ranges::find(before, option) == before.end();
    if (isOfLive) option->group("Live");
    if (isOfLive || option->check_name("--live") || option->check_name("--overlay")) {
      window[option->get_name()] =
          "Live needs a window; pitchboard-cli listen prints what robots and referee send";
    }
  }
  app.get_option("--after")->needs("--screenshot-to");
  app.get_option("--paint")->excludes("--render-scenario");
  for (const char* ofAVideo : {"--from", "--until", "--rate", "--only"}) {
    app.get_option(ofAVideo)->needs("--paint");
  }
  app.get_option("--only")->delimiter(',');
  shared::addGroup(app, "Pictures and videos",
                   {"--screenshot-to", "--after", "--play-to", "--size", "--render-scenario",
                    "--paint", "--picture", "--from", "--until", "--rate", "--only"});
  shared::addGroup(app, "Window", {"--theme", "--settings", "--new-window"});
  return window;
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
  const shared::WindowOptions window = addOptions(app, arguments);
  if (const auto ended = shared::parse(app, argc, argv, window)) return ended;
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
  TRY(setOptions(saved, link::liveOptionTable(), arguments.liveOptions));
  TRY(link::validate(saved));
  return saved;
}

}  // namespace pitchboard::studio
