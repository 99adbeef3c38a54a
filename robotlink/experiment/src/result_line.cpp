// SPDX-License-Identifier: GPL-3.0-or-later
#include "result_line.h"

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
constexpr std::size_t mostPaths = 70, mostCoordinates = 10'000;

Json valueOf(double value) {
  if (!std::isfinite(value)) return nullptr;
  // Whole numbers without ".0": most of them are counts.
  if (value == std::round(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
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
  if (!json.is_array() || json.size() > mostPaths) return false;
  for (const Json& entry : json) {
    if (!entry.is_array() || entry.size() != 2 || !entry[0].is_string() || !entry[1].is_array() ||
        entry[1].size() % 2 != 0 || entry[1].size() > mostCoordinates) {
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

}  // namespace

std::string lineOf(const RunResult& result) {
  char hash[24];
  std::snprintf(hash, sizeof hash, "0x%016" PRIx64, result.hash);
  Json values = Json::array();
  for (const double value : result.values) values.push_back(valueOf(value));
  Json out{{"run", result.number},  {"seed", result.seed}, {"end", result.endedBy},
           {"ticks", result.ticks}, {"hash", hash},        {"values", std::move(values)}};
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
  if (!json.is_object()) return wrongLine("is no JSON object");
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
  out.endedBy = text("end");
  if (!number || !seed || !ticks || !hash || out.endedBy.empty() || out.endedBy.size() > 32) {
    return wrongLine("has no run, seed, end, ticks or hash");
  }
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
    return wrongLine("has not " + std::to_string(metrics) + " values");
  }
  for (const Json& value : *values) {
    if (!value.is_null() && !value.is_number()) return wrongLine("has a value that is no number");
    out.values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                         : value.get<double>());
  }
  if (const auto paths = json.find("paths"); paths != json.end() && !readPaths(*paths, out)) {
    return wrongLine("has paths that cannot be read");
  }
  return out;
}

}  // namespace pitchboard::link
