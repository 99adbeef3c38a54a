// SPDX-License-Identifier: GPL-3.0-or-later
#include "what_if.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/experiment/statistics.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/match/tick_observer.h>
#include <robotlink/session/follow_recording.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/moment_scenario.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>

#include "interrupt.h"
#include "progress.h"

namespace pitchboard::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double forever = std::numeric_limits<double>::infinity();

/// The seconds of the session at which the match has its second 0.
double sessionTimeOfStart(const RecordedStart& start) {
  if (!start.moment) return start.time;
  // A row says both its time and its tick, whatever clock the session has.
  link::RecordedFrames frames(link::backdropOf(start.session));
  const sim::GameSnapshot& row = frames.frameAt(start.session, start.time).snapshot;
  return row.time - static_cast<double>(row.tick) / start.moment->state.settings.tickRate;
}

double lengthOf(const RecordedStart& start, const link::Scenario& scenario) {
  return scenario.stop.duration.value_or(forever) - start.matchTime();
}

/// How a stretch of a match ends: the side that scores first, or nothing.
using Scorer = std::optional<link::Side>;

/// Notes the first goal, and when followers were let go.
class RunObserver : public link::TickObserver {
 public:
  explicit RunObserver(double begin) : m_begin(begin) {}
  void ticked(const link::SimulatedMatch& match, std::chrono::nanoseconds /*time*/) override {
    const auto& at = match.followState().letGoAt;
    if (at) letGo = *at - m_begin;
  }
  void happened(std::span<const link::MatchEvent> events) override {
    for (const link::MatchEvent& event : events) {
      if (event.kind == link::MatchEventKind::Goal && !scorer) scorer = event.side;
    }
  }
  Scorer scorer;
  std::optional<double> letGo;  // s after the start

 private:
  double m_begin;
};

/// A goal of a live recording says which team scored, not on which side.
Scorer recordedScorer(const RecordedStart& start, const link::Scenario& scenario, double until) {
  std::vector<sim::RobotIdentity> robots;
  for (const link::ScenarioRobot& robot : scenario.robots) robots.push_back(robot.identity);
  std::vector<link::MatchEvent> events = link::eventsOf(start.session);
  link::dropUndone(events);
  for (const link::MatchEvent& event : events) {
    if (event.kind != link::MatchEventKind::Goal) continue;
    if (event.time <= start.time || event.time > until) continue;
    if (event.side) return event.side;
    return event.colour == link::teamOn(link::Side::Left, robots) ? link::Side::Left
                                                                  : link::Side::Right;
  }
  return {};
}

struct WhatIfResult {
  std::vector<Scorer> scorers;  // of each run
  std::vector<double> letGo;    // s after the start, of runs that let go
  Scorer recorded;
  double recordedSeconds = 0.0;  // how much of the time the recording covers
  double seconds = 0.0;
  std::uint64_t seed = 0;
  bool believed = false;  // what was followed
};

struct OutcomeRate {
  Scorer scorer;
  std::string name;  // "goal for blue"
  std::size_t runs = 0;
  double rate = 0.0;
  std::optional<link::Interval> interval;
};

std::vector<OutcomeRate> ratesOf(const WhatIfResult& result, const link::Scenario& scenario) {
  std::vector<sim::RobotIdentity> robots;
  for (const link::ScenarioRobot& robot : scenario.robots) robots.push_back(robot.identity);
  std::vector<OutcomeRate> rates;
  for (const Scorer scorer : {Scorer(link::Side::Left), Scorer(link::Side::Right), Scorer()}) {
    std::vector<double> values;
    for (const Scorer& one : result.scorers) values.push_back(one == scorer ? 1.0 : 0.0);
    const link::SampleMoments moments = link::momentsOf(values);
    OutcomeRate rate{scorer, "no goal", 0, moments.mean, link::intervalOfRate(moments)};
    rate.runs = static_cast<std::size_t>(std::ranges::count(values, 1.0));
    if (scorer) rate.name = "goal for " + std::string(info(link::teamOn(*scorer, robots)).name);
    rates.push_back(std::move(rate));
  }
  return rates;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void printRates(const WhatIfOptions& options, const RecordedStart& start,
                const WhatIfResult& result, const std::vector<OutcomeRate>& rates) {
  for (const std::string& note : start.notes) std::printf("%s\n", note.c_str());
  std::printf("From %s for %s: %zu runs, seeds %" PRIu64 " to %" PRIu64 "\n",
              secondsToText(start.time).c_str(), secondsToText(result.seconds).c_str(),
              result.scorers.size(), result.seed, result.seed + result.scorers.size() - 1);
  if (!options.follow.empty()) {
    std::printf("Following the recording%s: %s\n",
                result.believed ? ", as believed by the robots" : "",
                joined(options.follow).c_str());
  }
  std::printf("\n  %-16s %5s %8s   %-18s %s\n", "Outcome", "Runs", "Rate", "95 % interval",
              "Recorded");
  for (const OutcomeRate& rate : rates) {
    char interval[48] = "";
    if (rate.interval) {
      std::snprintf(interval, sizeof interval, "%.1f to %.1f %%", 100.0 * rate.interval->low,
                    100.0 * rate.interval->high);
    }
    const bool recorded = rate.scorer == result.recorded;
    std::printf("  %-16s %5zu %6.1f %%   %-18s %s\n", rate.name.c_str(), rate.runs,
                100.0 * rate.rate, interval, recorded ? "yes" : "");
  }
  if (!result.recorded && result.recordedSeconds < result.seconds) {
    std::printf("\nThe recording ends after %s.\n", secondsToText(result.recordedSeconds).c_str());
  }
  if (options.follow.empty()) return;
  const link::Summary letGo = link::summaryOf(result.letGo);
  std::printf("\nLet go in %zu of %zu runs", result.letGo.size(), result.scorers.size());
  if (!result.letGo.empty()) {
    std::printf(", after %.2f to %.2f s (median %.2f s)", letGo.least, letGo.most, letGo.median);
  }
  std::printf("\n");
}

void printRatesJson(const WhatIfOptions& options, const RecordedStart& start,
                    const WhatIfResult& result, const std::vector<OutcomeRate>& rates) {
  const auto sideOf = [](const Scorer& scorer) {
    return scorer ? Json(link::sideName(*scorer)) : Json(nullptr);
  };
  Json out{
      {"from", start.time},          {"seconds", result.seconds}, {"runs", result.scorers.size()},
      {"seed", result.seed},         {"follow", options.follow},  {"reach_m", options.reach},
      {"believed", result.believed}, {"notes", start.notes}};
  out["recorded"] = {{"goal", sideOf(result.recorded)}, {"seconds", result.recordedSeconds}};
  for (const OutcomeRate& rate : rates) {
    Json one{{"goal", sideOf(rate.scorer)},
             {"name", rate.name},
             {"runs", rate.runs},
             {"rate", rate.rate}};
    if (rate.interval) one["interval"] = {rate.interval->low, rate.interval->high};
    out["outcomes"].push_back(std::move(one));
  }
  out["let_go_s"] = result.letGo;
  std::printf("%s\n", out.dump().c_str());
}

}  // namespace

double RecordedStart::matchTime() const {
  return moment ? static_cast<double>(moment->state.tick) / moment->state.settings.tickRate : 0.0;
}

Result<RecordedStart> recordedStart(telemetry::SessionReader session, const std::string& path,
                                    double time) {
  auto moment = link::momentFromSession(session, time, link::VariableCatalog::published());
  const auto text = session.attachment(link::scenarioAttachment);
  std::optional<link::Scenario> scenario;
  if (text) scenario = TRY(link::scenarioFromJson(*text, path + ": scenario.json"));
  if (moment && scenario) {
    return RecordedStart{std::move(session), time, std::move(*scenario), std::move(*moment), {}};
  }
  if (!moment && session.count(telemetry::SessionStream::Checkpoints) > 0) {
    Error error = moment.error();
    error.context = error.context.empty() ? path : path + ": " + error.context;
    return tl::unexpected(std::move(error));
  }
  link::RecordedFrames frames(link::backdropOf(session));
  link::MomentOptions options;
  if (scenario) options.base = &*scenario;
  link::MomentScenario made = link::scenarioFromMoment(frames.frameAt(session, time), options);
  if (made.scenario.robots.empty()) {
    return failure(ErrorCode::NotFound,
                   "No robot's pose is known at this moment, so no match can start there. Choose "
                   "another moment.",
                   path);
  }
  return RecordedStart{
      std::move(session), time, std::move(made.scenario), {}, std::move(made.notes)};
}

Result<Following> followedBy(const WhatIfOptions& options, const RecordedStart& start,
                             const link::Scenario& scenario) {
  if (options.follow.empty()) return nullptr;
  const double zero = sessionTimeOfStart(start);
  link::FollowOptions follow{options.follow, options.reach, zero + start.matchTime(), 0.0,
                             start.matchTime()};
  follow.until = std::min(start.session.range()->end, follow.from + lengthOf(start, scenario));
  link::RecordedFrames frames(link::backdropOf(start.session));
  auto recording = link::recordingToFollow(
      [&](double time) {
        return std::make_shared<const link::MatchFrame>(frames.frameAt(start.session, time));
      },
      scenario, follow);
  if (!recording) return failure(recording.error().code, recording.error().message, "--follow");
  return std::make_shared<const link::FollowedRecording>(std::move(*recording));
}

Result<void> playWhatIf(const WhatIfOptions& options, const RecordedStart& start,
                        const link::Scenario& scenario, const Following& recording,
                        const PlayRun& play) {
  link::Scenario untilGoal = scenario;
  untilGoal.stop.goal = true;
  WhatIfResult result;
  result.believed = recording && recording->believed;
  result.seed = scenario.settings.seed;
  result.seconds = lengthOf(start, scenario);
  const double end = std::min(start.session.range()->end, start.time + result.seconds);
  result.recordedSeconds = end - start.time;
  result.recorded = recordedScorer(start, scenario, end);
  Progress progress("played", false);
  for (int run = 0; run < options.runs; ++run) {
    progress.show(std::to_string(run) + " of " + std::to_string(options.runs) + " runs");
    const auto observer = std::make_shared<RunObserver>(start.matchTime());
    untilGoal.settings.seed = result.seed + static_cast<std::uint64_t>(run);
    TRY(play(untilGoal, observer));
    if (interrupted) return failure(ErrorCode::Conflict, "Cancelled.");
    result.scorers.push_back(observer->scorer);
    // The end of the run is no reason.
    if (observer->letGo.value_or(forever) < result.seconds - 1e-6) {
      result.letGo.push_back(*observer->letGo);
    }
  }
  const std::vector<OutcomeRate> rates = ratesOf(result, scenario);
  (options.json ? printRatesJson : printRates)(options, start, result, rates);
  return {};
}

}  // namespace pitchboard::cli
