// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/situation_test.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include <base/short_name.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<SituationTemplate, 9> templates{{
    {.text = "A goal is scored in at least 8 of 10 runs",
     .assertion = "goal_rate >= 0.8",
     .goal = true,
     .goalAgainst = true},
    {.text = "No goal against", .assertion = "goal_against_rate == 0", .goalAgainst = true},
    {.text = "The ball stays on the field in 9 of 10 runs",
     .assertion = "ball_out_rate <= 0.1",
     .ballOut = true},
    {.text = "Nobody falls", .assertion = "fell_rate == 0", .fell = true},
    {.text = "Nobody gets stuck", .assertion = "stuck_rate == 0", .stuck = true},
    {.text = "Somebody kicks in every run", .assertion = "min(kicks) >= 1"},
    {.text = "At the end the robots know where they are",
     .assertion = "p90(belief_error_end_m) < 0.3"},
    {.text = "They have the ball most of the time", .assertion = "possession > 0.5"},
    {.text = "They hardly touch each other", .assertion = "mean(collisions) <= 1"},
}};

Json spreadJson(const StartSpread& spread) {
  Json out = Json::object();
  if (spread.x != 0.0) out["x"] = spread.x;
  if (spread.y != 0.0) out["y"] = spread.y;
  if (spread.heading != 0.0) out["heading"] = spread.heading;
  return out;
}

Json stopJson(const RunStop& stop) {
  Json out{{"duration", stop.duration}};
  // Said even when it is false: the scenario's own would be taken otherwise.
  out["goal"] = stop.goal;
  out["goal_against"] = stop.goalAgainst;
  out["ball_out"] = stop.ballOut;
  if (stop.fell) out["fell"] = true;
  if (stop.stuck) out["stuck"] = *stop.stuck;
  return out;
}

}  // namespace

MomentScenario situationScenario(const MatchFrame& frame, const MomentOptions& options) {
  MomentScenario out = scenarioFromMoment(frame, options);
  out.scenario.stop = {};
  return out;
}

Result<std::string> situationToJson(const SituationTest& situation) {
  if (situation.assertions.empty()) {
    return failure(ErrorCode::InvalidArgument, "there is no assertion; choose or write one");
  }
  Json out{{"version", 1},
           {"name", situation.name},
           {"title", situation.title},
           {"description", situation.description},
           {"scenario", Json::parse(scenarioToJson(situation.scenario))},
           {"team", info(situation.team).name},
           {"runs", situation.runs}};
  Json starts = Json::object();
  for (const StartSpread* spread : {&situation.robots, &situation.ball}) {
    if (Json one = spreadJson(*spread); !one.empty()) starts[spread->who] = std::move(one);
  }
  if (!starts.empty()) out["starts"] = std::move(starts);
  out["stop"] = stopJson(situation.stop);
  out["assertions"] = situation.assertions;
  std::string text = out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  const auto read = TRY(experimentFromJson(text, situation.name));
  return text;
}

std::span<const SituationTemplate> situationTemplates() {
  return templates;
}

std::string experimentNameFrom(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, maxShortNameLength)) {
    out += isShortNameLetter(c) ? c : '-';
  }
  return out.empty() ? "moment" : out;
}

}  // namespace pitchboard::link
