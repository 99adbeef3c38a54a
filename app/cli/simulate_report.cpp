// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate_report.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include <robotlink/match/followed_recording.h>

namespace pitchboard::cli {
namespace {

std::string hashText(std::uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016" PRIx64, hash);
  return text;
}

double speedOf(const Outcome& outcome) {
  return outcome.wallSeconds > 0 ? outcome.simulatedSeconds / outcome.wallSeconds : 0.0;
}

/// The team's programs that were started for the match.
std::vector<link::ProcessStatus> teamPrograms(const link::SimulatedMatch& match) {
  auto all = match.robots().processes().statuses();
  std::erase_if(all, [](const link::ProcessStatus& one) { return !one.isTeamProgram; });
  return all;
}

std::string robotName(const link::SimulatedMatch& match, RobotId id) {
  const auto index = match.simulation().indexOf(id);
  return index ? match.simulation().state().robots[*index].name() : std::to_string(id.value);
}

/// Share of the cycles that it would have done if it had kept up.
double keptOf(const link::ProcessStatus& program) {
  const auto all = static_cast<double>(program.cycles + program.missedCycles);
  return all > 0.0 ? static_cast<double>(program.cycles) / all : 1.0;
}

nlohmann::ordered_json programsJson(const link::SimulatedMatch& match) {
  auto programs = nlohmann::ordered_json::array();
  for (const link::ProcessStatus& one : teamPrograms(match)) {
    programs.push_back({{"name", robotName(match, one.robot) + ' ' + one.name},
                        {"clock", one.clock == link::ProcessClock::Match ? "match" : "real"},
                        {"speed", one.achieved > 0.0 ? one.achieved : one.speed},
                        {"kept", keptOf(one)},
                        {"cycles", one.cycles},
                        {"missed_cycles", one.missedCycles},
                        {"lines_left_out", one.linesLeftOut}});
  }
  return programs;
}

nlohmann::ordered_json deathsJson(const link::SimulatedMatch& match) {
  auto died = nlohmann::ordered_json::array();
  for (const link::ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.deaths == 0) continue;
    died.push_back({{"name", robotName(match, one.robot) + ' ' + one.name},
                    {"times", one.deaths},
                    {"last", one.lastDeath}});
  }
  return died;
}

/// What the robot did in this run: a match that goes on from a moment has counted before.
sim::RobotStatistics doneBy(const sim::RobotSnapshot& robot, const Outcome& outcome) {
  sim::RobotStatistics done = robot.statistics;
  const auto before = outcome.before.find(robot.identity.id);
  if (before == outcome.before.end()) return done;
  done.distanceWalked -= before->second.distanceWalked;
  done.kicks -= before->second.kicks;
  done.falls -= before->second.falls;
  done.unknownActions -= before->second.unknownActions;
  return done;
}

const char* reasonText(const std::string& finishedBy) {
  if (finishedBy == "goal") return "a goal was scored";
  if (finishedBy == "ball_out") return "the ball left the field";
  if (finishedBy == "duration") return "the time was up";
  if (finishedBy == "full_time") return "the final whistle";
  return "interrupted";
}

}  // namespace

void printResult(const link::SimulatedMatch& match, const Outcome& outcome) {
  const link::MatchResult result = match.result();
  std::printf("%s; %s%s\n", resultText(result).c_str(), reasonText(outcome.finishedBy),
              result.repeatable ? "" : "; not repeatable");
}

std::string noiseName(const sim::NoiseParameters& noise) {
  for (const std::string& name : link::noisePresets()) {
    if (const auto preset = link::noisePreset(name); preset && *preset == noise) return name;
  }
  return "custom";
}

bool keepsDying(const link::SimulatedMatch& match) {
  return std::ranges::any_of(match.robots().processes().statuses(),
                             &link::ProcessStatus::keepsDying);
}

void printSummary(const link::SimulatedMatch& match, const Outcome& outcome) {
  const sim::Snapshot now = match.simulation().snapshot();
  const link::Scenario& scenario = match.scenario();
  const sim::SimulationSettings& settings = match.simulation().state().settings;
  std::printf("%s (%s physics, %s noise, seed %" PRIu64 ")\n",
              (scenario.title.empty() ? scenario.name : scenario.title).c_str(),
              settings.physics.c_str(), outcome.noise == "none" ? "no" : outcome.noise.c_str(),
              settings.seed);
  std::printf("  Ended      %s\n", reasonText(outcome.finishedBy));
  std::printf("  Score      %s\n", resultText(match.result()).c_str());
  std::printf("  Time       %.2f s simulated in %.2f s, %" PRIu64 " ticks, %.1f x real time\n",
              outcome.simulatedSeconds, outcome.wallSeconds, outcome.ticks, speedOf(outcome));
  if (const link::FollowState& state = match.followState(); state.letGoAt) {
    std::printf("  Let go     at %.2f s: %s\n", *state.letGoAt, state.why.c_str());
  }
  std::printf("  State hash %s\n", hashText(match.simulation().hash()).c_str());
  if (!match.isRepeatable()) {
    std::printf("  Repeatable no: the match did not wait for a program's decision\n");
  }
  for (const link::ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.deaths == 0) continue;
    std::printf("  Died       %s %s, %d %s: %s\n", robotName(match, one.robot).c_str(),
                one.name.c_str(), one.deaths, one.deaths == 1 ? "time" : "times",
                one.lastDeath.c_str());
  }
  for (const link::ProcessStatus& one : teamPrograms(match)) {
    if (one.missedCycles == 0) continue;
    std::printf("  Missed     %" PRIu64 " of %" PRIu64
                " cycles by %s %s, which reaches %.1f x real time\n",
                one.missedCycles, one.cycles + one.missedCycles,
                robotName(match, one.robot).c_str(), one.name.c_str(), one.achieved);
  }
  for (const link::ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.linesLeftOut == 0) continue;
    std::printf("  Left out   %" PRIu64 " lines that %s %s wrote too fast\n", one.linesLeftOut,
                robotName(match, one.robot).c_str(), one.name.c_str());
  }
  if (now.robots.empty()) return;
  std::printf("  Robot   walked   kicks  falls  unknown actions\n");
  for (const sim::RobotSnapshot& robot : now.robots) {
    const sim::RobotStatistics done = doneBy(robot, outcome);
    std::printf("  %-5s %7.2f m  %5u  %5u  %15u\n", robot.identity.name().c_str(),
                done.distanceWalked, done.kicks, done.falls, done.unknownActions);
  }
}

void printJson(const link::SimulatedMatch& match, const Outcome& outcome) {
  using Json = nlohmann::ordered_json;
  const sim::Snapshot now = match.simulation().snapshot();
  const sim::SimulationSettings& settings = match.simulation().state().settings;
  Json robots = Json::array();
  for (const sim::RobotSnapshot& robot : now.robots) {
    const sim::RobotStatistics done = doneBy(robot, outcome);
    robots.push_back({{"id", robot.identity.id.value},
                      {"name", robot.identity.name()},
                      {"distance_m", done.distanceWalked},
                      {"kicks", done.kicks},
                      {"falls", done.falls},
                      {"unknown_actions", done.unknownActions}});
  }
  Json teams = Json::array();
  const link::MatchResult result = match.result();
  for (const link::TeamResult& team : result.teams) {
    Json one{{"side", link::sideName(team.side)}, {"colour", info(team.colour).name}};
    if (team.number) one["number"] = *team.number;
    if (!team.name.empty()) one["name"] = team.name;
    one["score"] = team.score;
    if (!team.byHalf.empty()) one["by_half"] = team.byHalf;
    if (team.wonToss) one["won_toss"] = true;
    teams.push_back(std::move(one));
  }
  Json out{{"scenario", match.scenario().name},
           {"seed", settings.seed},
           {"physics", settings.physics},
           {"noise", outcome.noise},
           {"ticks", outcome.ticks},
           {"simulated_seconds", outcome.simulatedSeconds},
           {"wall_seconds", outcome.wallSeconds},
           {"speed", speedOf(outcome)},
           {"score", {{"left", now.score.left}, {"right", now.score.right}}},
           {"teams", std::move(teams)},
           {"robots", std::move(robots)},
           {"finished_by", outcome.finishedBy},
           {"state_hash", hashText(match.simulation().hash())},
           {"repeatable", result.repeatable}};
  if (const link::FollowState& state = match.followState(); state.letGoAt) {
    out["let_go"] = {{"at", *state.letGoAt}, {"why", state.why}};
  }
  if (Json programs = programsJson(match); !programs.empty()) out["programs"] = std::move(programs);
  if (Json died = deathsJson(match); !died.empty()) out["died"] = std::move(died);
  std::printf("%s\n", out.dump().c_str());
}

}  // namespace pitchboard::cli
