// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_play.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <app/command_line.h>
#include <app/usage.h>
#include <base/try.h>
#include <robotlink/processes/team_program.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <robotlink/scenario/team_programs.h>

#include "interrupt.h"

namespace pitchboard::cli {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto pollInterval = 50ms;

/// Prints what processes write, and what happens to them.
class ProcessNews : public link::TickObserver {
 public:
  void ticked(const link::SimulatedMatch& /*match*/, std::chrono::nanoseconds /*time*/) override {}
  void happened(std::span<const link::MatchEvent> events) override {
    for (const link::MatchEvent& event : events) {
      using Kind = link::MatchEventKind;
      constexpr std::array reported{Kind::ProcessDied,        Kind::ProcessEnded,
                                    Kind::ProcessRestarted,   Kind::ProcessNotResponding,
                                    Kind::ProcessGivenUp,     Kind::ProcessRealTime,
                                    Kind::ProcessNotAttached, Kind::CycleLate};
      if (std::ranges::find(reported, event.kind) == reported.end()) continue;
      std::fprintf(stderr, "%s%s\n", link::info(event.kind).warning ? "warning: " : "",
                   link::sentenceOf(event).c_str());
    }
  }
  void logged(const LogLine& line) override {
    if (line.level < LogLevel::Info) return;
    std::fprintf(stderr, "%s: %s\n", line.origin.c_str(), line.text.c_str());
  }
};

/// Plays the match to its end and looks after its processes.
class Playing {
 public:
  Playing(link::MatchPlayer& player, double speed)
      : m_player(player), m_match(player.match()), m_begin(Clock::now()) {
    m_player.setSpeed(speed, m_begin);
    m_match.pace().setPlaying(speed, false, m_begin);
  }

  Outcome play(const std::function<bool()>& goOn) {
    const std::uint64_t first = m_player.currentTick();
    while (!interrupted && !m_match.finished()) {
      const auto next = m_player.play(Clock::now()).next;
      lookAfter();
      if (!goOn()) break;
      const auto now = Clock::now();
      if (next > now) std::this_thread::sleep_until(std::min(next, now + pollInterval));
    }
    m_player.lookAfterProcesses(Clock::now());  // their last lines
    if (m_match.nobodyPlays()) {
      std::fputs(
          "warning: no robot played, because none was told to. Add --referee "
          "humanoid-soccer-2026, or write COM_REFEREE = 2 in the scenario.\n",
          stderr);
    }
    Outcome outcome;
    outcome.ticks = m_player.currentTick() - first;
    outcome.simulatedSeconds =
        static_cast<double>(outcome.ticks) / m_match.simulation().state().settings.tickRate;
    outcome.wallSeconds = std::chrono::duration<double>(Clock::now() - m_begin).count();
    outcome.finishedBy = m_match.finished() ? std::string(m_match.finishedBy()) : "interrupted";
    outcome.noise = noiseName(m_match.simulation().state().settings.noise);
    return outcome;
  }

 private:
  void lookAfter() {
    const auto now = Clock::now();
    if (now - m_lastPoll >= pollInterval) {
      m_lastPoll = now;
      m_player.lookAfterProcesses(now);
    }
  }

  link::MatchPlayer& m_player;
  link::SimulatedMatch& m_match;
  Clock::time_point m_begin, m_lastPoll;
};

}  // namespace

void addPlayOptions(CLI::App& command, MatchPlayOptions& o) {
  shared::addScenarioOptions(command, o.match);
  shared::addRobotsOptions(command, o.robots);
  command.add_flag("--keep-speed", o.keepSpeed,
                   "Do not slow down to team programs that cannot keep up");
  std::string ruleSets;
  for (const link::RuleSetInfo& set : link::refereeRuleSets()) ruleSets += ", " + set.name;
  command
      .add_option(
          "--referee", o.rules,
          "Rules instead of the scenario's: " + ruleSets.substr(2) + " (published: no referee)")
      ->type_name("RULES");
  command
      .add_option("--obey-referee", o.obeyReferee,
                  "Obey the GameController that sends to this UDP port")
      ->type_name("PORT")
      ->check(CLI::Range(1, 65535));
  command
      .add_option("--answer-referee", o.answerReferee,
                  "Robots answer that GameController (RGrt), on this UDP port of its computer; 0: "
                  "that of its version, 3838 or 3939")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535))
      ->needs("--obey-referee");
  command
      .add_option("--robot-program", o.robotProgram,
                  "Program of separate processes; default: pitchboard-robot beside this program")
      ->type_name("FILE");
  shared::addGroup(command, "Robot processes", {"--robot-program", "--keep-speed"});
  shared::addGroup(command, "Referee", {"--obey-referee", "--answer-referee"});
}

Result<double> speedOf(const MatchPlayOptions& options, link::Cognition cognition,
                       const link::Scenario& scenario) {
  const std::string& text = options.robots.speed;
  if (text.empty()) {
    const bool ownPace = cognition == link::Cognition::Inline && !options.obeyReferee &&
                         !TRY(link::usesTeamPrograms(scenario));
    return ownPace ? 0.0 : 1.0;
  }
  return shared::speedFrom(text);
}

Result<link::Scenario> scenarioToPlay(Result<link::Scenario> scenario,
                                      const MatchPlayOptions& options, link::Cognition cognition) {
  if (!scenario) return scenario;
  if (!options.rules.empty()) {
    scenario->settings.referee = TRY(link::refereeRuleSet(options.rules));
  }
  if (options.duration) {
    scenario->stop.duration = options.duration;
  } else if (scenario->stop == link::StopConditions{} && cognition != link::Cognition::None &&
             !(scenario->settings.referee && scenario->settings.referee->automatic)) {
    scenario->stop.duration = defaultDuration;
  }
  scenario = shared::withRuntimes(std::move(*scenario), options.robots);
  // With none, somebody else starts the programs that the scenario names.
  if (scenario && cognition == link::Cognition::None && !options.robots.runtimes.empty() &&
      TRY(link::usesTeamPrograms(*scenario))) {
    return failure(ErrorCode::InvalidArgument,
                   "--runtime names a program to start, but --cognition none starts none; leave "
                   "one of them out");
  }
  return scenario;
}

Result<link::SimulatedMatch> createMatch(const link::Scenario& scenario,
                                         const MatchPlayOptions& options,
                                         link::Cognition cognition) {
  const auto speed = TRY(speedOf(options, cognition, scenario));
  shared::warnOfIgnoredSettings(scenario);
  link::MatchOptions made;
  made.speed = speed;
  made.waitForTeamPrograms = !options.keepSpeed;
  made.cognition = cognition;
  shared::apply(options.robots, made);
  made.robotProgram = options.robotProgram.empty() ? link::besideTeamProgram("pitchboard-robot")
                                                   : options.robotProgram;
  made.obeyReferee = options.obeyReferee;
  made.answerReferee = options.answerReferee;
  auto match = link::SimulatedMatch::create(scenario, made);
  if (!match) return match;
  if (const std::string notice = shared::numberNotice(*match); !notice.empty()) {
    std::fprintf(stderr, "%s\n", notice.c_str());
  }
  return match;
}

Outcome playToEnd(link::MatchPlayer& player, double speed, const std::function<bool()>& goOn) {
  player.observe(std::make_shared<ProcessNews>());
  const sim::Snapshot before = player.match().simulation().snapshot();
  Outcome outcome = Playing(player, speed).play(goOn);
  for (const sim::RobotSnapshot& robot : before.robots) {
    outcome.before.emplace(robot.identity.id, robot.statistics);
  }
  return outcome;
}

}  // namespace pitchboard::cli
