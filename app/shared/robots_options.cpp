// SPDX-License-Identifier: GPL-3.0-or-later
#include <app/robots_options.h>
#include <app/usage.h>

#include <algorithm>

#include <base/lined_json.h>

namespace pitchboard::shared {

void addRobotsOptions(CLI::App& command, RobotsOptions& options) {
  command
      .add_option(
          "--match", options.match,
          "Number of the match on this computer; sets blackboard keys and ports. Default: the "
          "next free one (0 uses the published keys and ports)")
      ->type_name("N")
      ->check(CLI::Range(0, link::MatchNumber::most));
  command
      .add_option("--key-base", options.keyBase,
                  "Blackboard keys are this + 100 x robot number; default: the match's")
      ->type_name("B")
      ->check(CLI::Range(0, 2'000'000'000));
  command
      .add_option(
          "--pace", options.pace,
          "How separate reference processes run at speed 1: the match waits for them in every "
          "tick (lock-step), or they run freely, as on the field")
      ->type_name("lock-step|free")
      ->capture_default_str()
      ->check(CLI::IsMember({"lock-step", "free"}));
  command
      .add_option(
          "--runtime", options.runtimes,
          "Programs of the robots: a runtime profile (reference, own, "
          "published-tree:folder=..., a file) or program=FILE instead of decision; put blue= or "
          "B1= in front for one team or robot; may be repeated")
      ->type_name("[WHO=]PROFILE");
  addGroup(command, "Robot processes", {"--match", "--key-base", "--pace", "--runtime"});
}

Result<link::Scenario> withRuntimes(link::Scenario scenario, const RobotsOptions& options) {
  for (const std::string& text : options.runtimes) {
    const std::size_t equals = text.find('=');
    const std::string who = equals == std::string::npos ? std::string() : text.substr(0, equals);
    const auto team = std::ranges::find(teamColors, who, &TeamColorInfo::name);
    const auto robot = std::ranges::find_if(
        scenario.robots, [&who](const auto& one) { return one.identity.name() == who; });
    const bool isShirt =
        who.size() >= 2 && who.size() <= 3 && who[0] >= 'A' && who[0] <= 'Z' &&
        std::all_of(who.begin() + 1, who.end(), [](char c) { return c >= '0' && c <= '9'; });
    const bool named = team != teamColors.end() || isShirt;
    const auto choice = link::runtimeChoiceFromText(named ? text.substr(equals + 1) : text);
    if (!choice) return failure(choice.error().code, choice.error().message, "--runtime");
    if (const auto profile = link::loadRuntime(*choice); !profile) {
      return failure(profile.error().code, profile.error().text(), "--runtime");
    }
    if (team != teamColors.end()) {
      scenario.runtimes[team->color] = *choice;
    } else if (robot != scenario.robots.end()) {
      robot->runtime = *choice;
    } else if (isShirt) {
      return failure(ErrorCode::NotFound, "there is no robot " + who + " in this scenario",
                     "--runtime");
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
