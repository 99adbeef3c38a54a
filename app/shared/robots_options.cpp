// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/option_arguments.h>
#include <app/robots_options.h>
#include <app/usage.h>

#include <algorithm>
#include <cctype>

#include <base/lined_json.h>

namespace pitchboard::shared {

namespace {

template <auto member>
constexpr OptionAccess<RobotsOptions> robotsMember = optionMember<RobotsOptions, member>;

std::vector<OptionChoice> cognitionChoices() {
  return {{std::string("inline"), {}}, {std::string("separate"), {}}, {std::string("none"), {}}};
}
std::vector<OptionChoice> paceChoices() {
  return {{std::string("lock-step"), {}}, {std::string("free"), {}}};
}

// clang-format off
constexpr Option<RobotsOptions> robotsTable[] = {
    {{.name = "cognition", .form = "inline|separate|none",
      .text = "Who decides: processes inside this program (inline), separate processes on System V "
              "blackboards (separate), or only processes that you start (none)",
      .choices = cognitionChoices}, robotsMember<&RobotsOptions::cognition>},
    {{.name = "speed", .form = "X|max",
      .text = "Times real time, 0.01 to 1000, or max; default: 1, in pitchboard-cli max unless "
              "something needs real time"},
      robotsMember<&RobotsOptions::speed>},
    {{.name = "match", .form = "N",
      .text = "Number of the match on this computer; sets blackboard keys and ports. Default: the "
              "next free one (0 uses the published keys and ports)",
      .min = 0, .max = link::MatchNumber::most}, robotsMember<&RobotsOptions::match>},
    {{.name = "key-base", .form = "B",
      .text = "Blackboard keys are this + 100 x robot number; default: the match's",
      .min = 0, .max = 2'000'000'000}, robotsMember<&RobotsOptions::keyBase>},
    {{.name = "pace", .form = "lock-step|free",
      .text = "How separate reference processes run at speed 1: the match waits for them in every "
              "tick (lock-step), or they run freely, as on the field",
      .choices = paceChoices}, robotsMember<&RobotsOptions::pace>},
    {{.name = "runtime", .form = "[WHO=]PROFILE",
      .text = "Programs of the robots: program=FILE instead of decision, or a runtime profile "
              "(reference, own, published-tree:folder=..., a file); B1= or blue= in front: of one "
              "robot or team"}, robotsMember<&RobotsOptions::runtimes>},
};
// clang-format on

}  // namespace

void addRobotsOptions(CLI::App& command, RobotsOptions& options) {
  addOptions(command, robotsTable, options);
  // The name up to version 0.14.
  command.get_option("--cognition")->transform([](const std::string& text) {
    return text == "external" ? "separate" : text;
  });
  addGroup(command, "Robot processes", {"--match", "--key-base", "--pace"});
}

link::Cognition cognitionOf(const RobotsOptions& options) {
  return options.cognition == "inline" ? link::Cognition::Inline
         : options.cognition == "none" ? link::Cognition::None
                                       : link::Cognition::Separate;
}

Result<link::Scenario> withRuntimes(link::Scenario scenario, const RobotsOptions& options) {
  for (const std::string& text : options.runtimes) {
    const std::size_t equals = text.find('=');
    std::string who = equals == std::string::npos ? std::string() : text.substr(0, equals);
    const bool isShirt =
        who.size() >= 2 && who.size() <= 3 && std::isalpha(static_cast<unsigned char>(who[0])) &&
        std::all_of(who.begin() + 1, who.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (isShirt) who[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(who[0])));
    const auto team = std::ranges::find(teamColors, who, &TeamColorInfo::name);
    const auto robot = scenario.robotNamed(who);
    const bool named = team != teamColors.end() || isShirt;
    const auto choice = link::runtimeChoiceFromText(named ? text.substr(equals + 1) : text);
    if (!choice) return failure(choice.error().code, choice.error().message, "--runtime");
    if (const auto profile = link::loadRuntime(*choice); !profile) {
      // As it has to be written here, with the robot in front.
      std::string said = profile.error().text();
      constexpr std::string_view advice = "write program=";
      if (const std::size_t at = said.find(advice); named && at != std::string::npos) {
        said.insert(at + advice.find("program"), who + '=');
      }
      return failure(profile.error().code, said, "--runtime");
    }
    if (team != teamColors.end()) {
      scenario.runtimes[team->color] = *choice;
    } else if (robot) {
      scenario.robots[*robot].runtime = *choice;
    } else if (isShirt) {
      return failure(robot.error().code, robot.error().message, "--runtime");
    } else {
      for (const TeamColorInfo& color : teamColors) scenario.runtimes[color.color] = *choice;
    }
  }
  return scenario;
}

void apply(const RobotsOptions& options, link::MatchOptions& match) {
  match.match = options.match;
  match.keyBase = options.keyBase;
  match.pace = options.pace == "free" ? link::RobotsPace::Free : link::RobotsPace::LockStep;
}

std::string numberNotice(const link::SimulatedMatch& match) {
  const auto& claim = match.robots().claim();
  if (!claim || claim->number().value == 0) return {};
  const link::MatchNumber number = claim->number();
  std::string text = "match " + std::to_string(number.value) + ": blackboards have keys " +
                     std::to_string(number.keyBase()) +
                     " + 100 x robot number, telemetry goes to " +
                     std::to_string(number.telemetryPortBase()) + " + robot number";
  if (!claim->publishedHolder().empty()) {
    text += ", because match 0 is played by " + claim->publishedHolder();
  }
  return text;
}

}  // namespace pitchboard::shared
