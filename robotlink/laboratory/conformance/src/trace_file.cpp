// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <memory>
#include <sstream>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

constexpr int maxFrames = 10'000'000;
constexpr std::size_t maxRobots = 64;
constexpr std::size_t maxBytes = 1ULL << 30;
constexpr std::size_t maxTextBytes = std::size_t{64} << 20;

/// Everything in a trace must be there: what is left out is not a default.
double number(const JsonObject& object, std::string_view key) {
  object.require(key);
  return object.number(key, 0.0, anyNumber);
}

int wholeNumber(const JsonObject& object, std::string_view key, int least, int most) {
  object.require(key);
  return object.integer(key, least, least, most);
}

int anyInt(const JsonObject& object, std::string_view key) {
  return wholeNumber(object, key, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

std::string text(const JsonObject& object, std::string_view key) {
  object.require(key);
  return object.text(key, {}, maxTextBytes);
}

/// The object of that key; an empty one after a complaint.
JsonObject object(JsonReport& report, const JsonObject& parent, std::string_view key) {
  static const JsonNode nothing = [] {
    JsonNode node;
    node.kind = JsonNode::Kind::Object;
    return node;
  }();
  parent.require(key);
  const JsonNode* node = parent.find(key);
  return {report, node ? *node : nothing, parent.pathOf(key)};
}

TeamColor teamOf(const JsonObject& robot) {
  constexpr std::array<std::string_view, 5> names{"CYAN", "MAGENTA", "BLACK", "ORANGE", "YELLOW"};
  constexpr std::array<TeamColor, 5> teams{TeamColor::Blue, TeamColor::Red, TeamColor::Black,
                                           TeamColor::Orange, TeamColor::Yellow};
  robot.require("color");
  return teams[robot.choice("color", names, "published colour").value_or(0)];
}

TraceRobot robotFrom(JsonReport& report, const JsonObject& json) {
  TraceRobot robot;
  robot.x = number(json, "x");
  robot.y = number(json, "y");
  robot.rotate = number(json, "rotate");
  robot.team = teamOf(json);
  const int imu = anyInt(json, "imu_initial_value");
  if (imu != 0 && imu != 180) json.fail("imu_initial_value", "must be 0 or 180");
  robot.imuStartsAt180 = imu == 180;
  if (json.find("bkb_int")) {
    const JsonObject ints = object(report, json, "bkb_int");
    for (const auto& [name, value] : ints.members()) {
      robot.initialInts.emplace_back(name, anyInt(ints, name));
    }
  }
  return robot;
}

using ReadOperation = TraceOperation (*)(const JsonObject&, std::size_t robots);

std::size_t robotIndex(const JsonObject& json, std::size_t robots) {
  return static_cast<std::size_t>(wholeNumber(json, "robot", 1, static_cast<int>(robots))) - 1;
}

constexpr std::array<std::string_view, 6> operationNames{"bkb_int",  "bkb_float",   "robot_place",
                                                         "ball_new", "ball_motion", "game_stop"};
constexpr std::array<ReadOperation, operationNames.size()> operations{
    [](const JsonObject& j, std::size_t n) -> TraceOperation {
      return WriteInt{robotIndex(j, n), text(j, "var"), anyInt(j, "value")};
    },
    [](const JsonObject& j, std::size_t n) -> TraceOperation {
      return WriteFloat{robotIndex(j, n), text(j, "var"), number(j, "value")};
    },
    [](const JsonObject& j, std::size_t n) -> TraceOperation {
      return PlaceTraceRobot{robotIndex(j, n), number(j, "x"), number(j, "y"), number(j, "rotate"),
                             number(j, "view_rot")};
    },
    [](const JsonObject& j, std::size_t) -> TraceOperation {
      return NewBall{number(j, "x"), number(j, "y")};
    },
    [](const JsonObject& j, std::size_t) -> TraceOperation {
      return MoveBall{number(j, "speed"), number(j, "angle")};
    },
    [](const JsonObject& j, std::size_t) -> TraceOperation {
      return StopGame{anyInt(j, "value") != 0};
    },
};

ScheduledOperation operationFrom(const JsonObject& json, std::size_t robots) {
  const int frame = wholeNumber(json, "frame", 1, maxFrames);
  json.require("op");
  const auto operation = json.choice("op", operationNames, "operation");
  if (!operation) return {};
  return {frame, operations[*operation](json, robots)};
}

Trace traceFrom(JsonReport& report, const JsonNode& root) {
  Trace trace;
  const JsonObject json(report, root, "");
  trace.name = text(json, "name");
  trace.frames = wholeNumber(json, "frames", 0, maxFrames);
  trace.naiveEvery = json.integer("naive_every", trace.naiveEvery, 1, maxFrames);
  if (const JsonNode* crash = json.find("crash"); crash && crash->kind != JsonNode::Kind::Null) {
    trace.crashFrame = wholeNumber(object(report, json, "crash"), "frame", 1, maxFrames);
  }
  const JsonObject ball = object(report, json, "ball");
  trace.ballX = number(ball, "x");
  trace.ballY = number(ball, "y");
  trace.ballFriction = number(ball, "friction");
  json.require("robots");
  const auto* robots = json.array("robots", maxRobots);
  for (std::size_t i = 0; robots && i < robots->size() && !report.failed(); ++i) {
    trace.robots.push_back(
        robotFrom(report, JsonObject(report, (*robots)[i], json.pathOf("robots", i))));
  }
  json.require("schedule");
  const auto* schedule = json.array("schedule", maxFrames);
  for (std::size_t i = 0; schedule && i < schedule->size() && !report.failed(); ++i) {
    trace.schedule.push_back(operationFrom(
        JsonObject(report, (*schedule)[i], json.pathOf("schedule", i)), trace.robots.size()));
  }
  std::ranges::stable_sort(trace.schedule,
                           [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return trace;
}

Result<std::string> readGzip(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  if (!file) return failure(ErrorCode::NotFound, "The recorded rows cannot be opened.", path);
  std::string content;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const int got = gzread(file.get(), buffer.data(), buffer.size());
    if (got < 0) return failure(ErrorCode::ParseError, "The gzip data is damaged.", path);
    if (got == 0) break;
    content.append(buffer.data(), static_cast<std::size_t>(got));
    if (content.size() > maxBytes) {
      return failure(ErrorCode::Unsupported, "The recorded rows are larger than 1 GiB.", path);
    }
  }
  int state = Z_OK;
  gzerror(file.get(), &state);
  if (state != Z_OK && state != Z_STREAM_END) {
    return failure(ErrorCode::ParseError, "The gzip data is damaged or truncated.", path);
  }
  return content;
}

Result<void> readRows(Trace& trace, const std::string& path) {
  auto content = TRY(readGzip(path));
  const std::string_view all = content;
  std::size_t position = 0;
  int line = 0;
  const auto nextLine = [&]() -> std::string_view {
    const std::size_t end = std::min(all.find('\n', position), all.size());
    std::string_view found = all.substr(position, end - position);
    if (found.ends_with('\r')) found.remove_suffix(1);
    position = std::min(end + 1, all.size());
    ++line;
    return found;
  };
  const auto malformed = [&](const std::string& what) {
    return failure(ErrorCode::ParseError, what, path + ":" + std::to_string(line));
  };

  std::istringstream header{std::string(nextLine())};
  for (std::string column; std::getline(header, column, ',');) trace.columns.push_back(column);
  if (trace.columns.empty() || trace.columns.front() != "frame") {
    return malformed("The first column must be \"frame\".");
  }
  while (position < all.size()) {
    const std::string_view row = nextLine();
    if (row.empty()) continue;
    std::vector<double> values;
    values.reserve(trace.columns.size());
    const char* at = row.data();
    const char* const end = row.data() + row.size();
    while (at <= end) {
      double value = 0.0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc{} || (next != end && *next != ',')) {
        return malformed("Column " + std::to_string(values.size() + 1) + " is not a number.");
      }
      values.push_back(value);
      at = next + 1;
    }
    if (values.size() != trace.columns.size()) {
      return malformed("The row has " + std::to_string(values.size()) + " values, the header " +
                       std::to_string(trace.columns.size()) + " columns.");
    }
    trace.rows.push_back(std::move(values));
  }
  const int expected = trace.crashFrame > 0 ? trace.crashFrame : trace.frames + 1;
  if (static_cast<int>(trace.rows.size()) != expected) {
    return failure(ErrorCode::ParseError,
                   "The file has " + std::to_string(trace.rows.size()) + " rows where " +
                       std::to_string(expected) + " are announced.",
                   path);
  }
  return {};
}

}  // namespace

Result<Trace> readTrace(const std::string& jsonPath) {
  constexpr std::string_view extension = ".json";
  if (!jsonPath.ends_with(extension)) {
    return failure(ErrorCode::InvalidArgument, "A trace is named by its .json file.", jsonPath);
  }
  const auto text = TRY(readFile(jsonPath, maxTextBytes, "The trace"));
  JsonReport report(jsonPath);
  Trace trace;
  if (const auto root = parseJson(text, report, maxTextBytes)) trace = traceFrom(report, *root);
  if (report.failed()) {
    Error error = report.error();
    error.message = "Not a trace: " + error.message;
    return tl::unexpected(error);
  }
  const std::string rows = jsonPath.substr(0, jsonPath.size() - extension.size()) + ".csv.gz";
  TRY(readRows(trace, rows));
  return trace;
}

}  // namespace pitchboard::link
