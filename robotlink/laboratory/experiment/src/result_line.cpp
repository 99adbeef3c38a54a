// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_line.h"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;
constexpr double centimetres = 100.0;
constexpr std::size_t maxPaths = 40 * maxPathPoints, maxCoordinates = 10'000, maxHalves = 4;
constexpr std::uint64_t maxGoals = 1'000'000;

Json valueOf(double value) {
  if (!std::isfinite(value)) return nullptr;
  // Whole numbers without ".0": most of them are counts.
  if (value == std::round(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

Json teamResultJson(const TeamResult& team) {
  Json out{{"colour", info(team.colour).name}, {"side", sideName(team.side)}};
  if (!team.name.empty()) out["name"] = team.name;
  if (team.number) out["number"] = *team.number;
  out["score"] = team.score;
  if (!team.byHalf.empty()) out["by_half"] = team.byHalf;
  if (team.wonToss) out["won_toss"] = true;
  return out;
}

tl::unexpected<Error> wrongLine(std::string sentence) {
  return failure(ErrorCode::ParseError, std::move(sentence));
}

std::optional<std::uint64_t> hashFrom(std::string_view text) {
  if (text.size() != 18 || !text.starts_with("0x")) return {};
  std::uint64_t hash = 0;
  const auto [end, code] = std::from_chars(text.data() + 2, text.data() + text.size(), hash, 16);
  if (code != std::errc() || end != text.data() + text.size()) return {};
  return hash;
}

bool readPaths(const Json& json, RunResult& result) {
  if (!json.is_array() || json.size() > maxPaths) return false;
  for (const Json& entry : json) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_string() || !entry[1].is_array() ||
        entry[1].size() % 2 != 0 || entry[1].size() > maxCoordinates) {
      return false;
    }
    RunPath path{entry[0], {}};
    for (std::size_t i = 0; i < entry[1].size(); i += 2) {
      if (!entry[1][i].is_number() || !entry[1][i + 1].is_number()) return false;
      path.points.push_back(
          {entry[1][i].get<double>() / centimetres, entry[1][i + 1].get<double>() / centimetres});
    }
    result.paths.push_back(std::move(path));
  }
  return true;
}

bool isCount(const Json& json) {
  return json.is_number_unsigned() && json.get<std::uint64_t>() <= maxGoals;
}

bool readTeam(const Json& json, TeamResult& team) {
  if (!json.is_object()) return false;
  const auto text = [&json](const char* key) { return json.value(key, Json("")); };
  const Json colour = text("colour"), side = text("side"), name = text("name");
  const Json score = json.value("score", Json()), halves = json.value("by_half", Json::array());
  if (!colour.is_string() || !side.is_string() || !name.is_string() || !isCount(score) ||
      !halves.is_array() || halves.size() > maxHalves || !std::ranges::all_of(halves, isCount)) {
    return false;
  }
  const auto known = teamColorNamed(colour.get<std::string>());
  const auto defends = sideNamed(side.get<std::string>());
  if (!known || !defends) return false;
  team.colour = *known;
  team.side = *defends;
  team.name = name.get<std::string>();
  team.score = score.get<int>();
  team.wonToss = json.value("won_toss", Json(false)) == Json(true);
  for (const Json& goals : halves) team.byHalf.push_back(goals.get<int>());
  if (const auto number = json.find("number"); number != json.end()) {
    if (!isCount(*number)) return false;
    team.number = number->get<int>();
  }
  return true;
}

bool readTeams(const Json& json, MatchResult& match) {
  if (!json.is_array() || json.size() != match.teams.size()) return false;
  return readTeam(json[0], match.teams[0]) && readTeam(json[1], match.teams[1]);
}

}  // namespace

std::string lineOf(const RunResult& result) {
  char hash[24];
  std::snprintf(hash, sizeof hash, "0x%016" PRIx64, result.hash);
  Json values = Json::array();
  for (const double value : result.values) values.push_back(valueOf(value));
  Json teams = Json::array();
  for (const TeamResult& team : result.match.teams) teams.push_back(teamResultJson(team));
  Json out{{"run", result.number},
           {"seed", result.seed},
           {"end", result.match.endedBy},
           {"ticks", result.ticks},
           {"hash", hash},
           {"repeatable", result.match.repeatable},
           {"teams", std::move(teams)},
           {"values", std::move(values)}};
  if (!result.paths.empty()) {
    Json paths = Json::array();
    for (const RunPath& path : result.paths) {
      Json points = Json::array();
      for (const Point& point : path.points) {
        points.push_back(static_cast<int>(std::lround(point.x * centimetres)));
        points.push_back(static_cast<int>(std::lround(point.y * centimetres)));
      }
      paths.push_back(Json::array({path.who, std::move(points)}));
    }
    out["paths"] = std::move(paths);
  }
  return out.dump() + '\n';
}

Result<RunResult> resultFromLine(std::string_view line, const Experiment& experiment,
                                 std::size_t metrics) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return wrongLine("is not a JSON object");
  const auto whole = [&json](const char* key) -> std::optional<std::uint64_t> {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_unsigned()) return {};
    return found->get<std::uint64_t>();
  };
  const auto text = [&json](const char* key) -> std::string {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto number = whole("run"), seed = whole("seed"), ticks = whole("ticks");
  const auto hash = hashFrom(text("hash"));
  RunResult out;
  out.match.endedBy = text("end");
  if (!number || !seed || !ticks || !hash || out.match.endedBy.empty() ||
      out.match.endedBy.size() > 32) {
    return wrongLine("has no run, seed, end, ticks or hash");
  }
  const Json repeatable = json.value("repeatable", Json());
  if (!repeatable.is_boolean() || !readTeams(json.value("teams", Json()), out.match)) {
    return wrongLine("does not say how the match ended for both teams");
  }
  out.match.repeatable = repeatable.get<bool>();
  if (*number < 1 || *number > experiment.allRuns()) {
    return wrongLine("has run " + std::to_string(*number) + ", but the experiment has " +
                     std::to_string(experiment.allRuns()));
  }
  out.number = static_cast<std::size_t>(*number);
  out.seed = *seed;
  out.ticks = *ticks;
  out.hash = *hash;
  const auto values = json.find("values");
  if (values == json.end() || !values->is_array() || values->size() != metrics) {
    return wrongLine("must have " + std::to_string(metrics) + " values");
  }
  for (const Json& value : *values) {
    if (!value.is_null() && !value.is_number())
      return wrongLine("has a value that is not a number");
    out.values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                         : value.get<double>());
  }
  if (const auto paths = json.find("paths"); paths != json.end() && !readPaths(*paths, out)) {
    return wrongLine("has paths that cannot be read");
  }
  return out;
}

}  // namespace pitchboard::link
