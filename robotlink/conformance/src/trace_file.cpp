// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include <base/read_file.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::json;

constexpr int mostFrames = 10'000'000;
constexpr std::size_t mostRobots = 64;
constexpr std::size_t mostBytes = 1ULL << 30;
constexpr std::size_t mostTextBytes = std::size_t{64} << 20;

/// Thrown and caught inside this file only; the text says which key is wrong.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

const Json& member(const Json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw Malformed(where + " must be an object");
  const auto it = object.find(key);
  if (it == object.end()) throw Malformed(where + " has no \"" + key + "\"");
  return *it;
}

double number(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number()) throw Malformed(where + "." + key + " must be a number");
  return value.get<double>();
}

int wholeNumber(const Json& object, const char* key, const std::string& where, int least,
                int most) {
  const double value = number(object, key, where);
  if (value != std::floor(value) || value < least || value > most) {
    throw Malformed(where + "." + key + " must be a whole number from " + std::to_string(least) +
                    " to " + std::to_string(most));
  }
  return static_cast<int>(value);
}

int anyInt(const Json& object, const char* key, const std::string& where) {
  return wholeNumber(object, key, where, std::numeric_limits<int>::min(),
                     std::numeric_limits<int>::max());
}

std::string text(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_string()) throw Malformed(where + "." + key + " must be a text");
  return value.get<std::string>();
}

TeamColor teamOf(const std::string& color, const std::string& where) {
  struct Name {
    const char* published;
    TeamColor team;
  };
  constexpr std::array<Name, 5> names{{{"CYAN", TeamColor::Blue},
                                       {"MAGENTA", TeamColor::Red},
                                       {"BLACK", TeamColor::Black},
                                       {"ORANGE", TeamColor::Orange},
                                       {"YELLOW", TeamColor::Yellow}}};
  for (const Name& name : names) {
    if (color == name.published) return name.team;
  }
  throw Malformed(where + ".color \"" + color + "\" is not one of the published colours");
}

TraceRobot robotFrom(const Json& json, const std::string& where) {
  TraceRobot robot;
  robot.x = number(json, "x", where);
  robot.y = number(json, "y", where);
  robot.rotate = number(json, "rotate", where);
  robot.team = teamOf(text(json, "color", where), where);
  const int imu = anyInt(json, "imu_initial_value", where);
  if (imu != 0 && imu != 180) throw Malformed(where + ".imu_initial_value must be 0 or 180");
  robot.imuStartsAt180 = imu == 180;
  if (const auto ints = json.find("bkb_int"); ints != json.end()) {
    if (!ints->is_object()) throw Malformed(where + ".bkb_int must be an object");
    for (const auto& [name, value] : ints->items()) {
      robot.initialInts.emplace_back(name, anyInt(*ints, name.c_str(), where + ".bkb_int"));
    }
  }
  return robot;
}

using ReadOperation = TraceOperation (*)(const Json&, const std::string&, std::size_t robots);

std::size_t robotIndex(const Json& json, const std::string& where, std::size_t robots) {
  return static_cast<std::size_t>(wholeNumber(json, "robot", where, 1, static_cast<int>(robots))) -
         1;
}

constexpr std::array<std::pair<const char*, ReadOperation>, 6> operations{{
    {"bkb_int",
     [](const Json& j, const std::string& w, std::size_t n) -> TraceOperation {
       return WriteInt{robotIndex(j, w, n), text(j, "var", w), anyInt(j, "value", w)};
     }},
    {"bkb_float",
     [](const Json& j, const std::string& w, std::size_t n) -> TraceOperation {
       return WriteFloat{robotIndex(j, w, n), text(j, "var", w), number(j, "value", w)};
     }},
    {"robot_place",
     [](const Json& j, const std::string& w, std::size_t n) -> TraceOperation {
       return PlaceTraceRobot{robotIndex(j, w, n), number(j, "x", w), number(j, "y", w),
                              number(j, "rotate", w), number(j, "view_rot", w)};
     }},
    {"ball_new",
     [](const Json& j, const std::string& w, std::size_t) -> TraceOperation {
       return NewBall{number(j, "x", w), number(j, "y", w)};
     }},
    {"ball_motion",
     [](const Json& j, const std::string& w, std::size_t) -> TraceOperation {
       return MoveBall{number(j, "speed", w), number(j, "angle", w)};
     }},
    {"game_stop",
     [](const Json& j, const std::string& w, std::size_t) -> TraceOperation {
       return StopGame{anyInt(j, "value", w) != 0};
     }},
}};

ScheduledOperation operationFrom(const Json& json, const std::string& where, std::size_t robots) {
  const int frame = wholeNumber(json, "frame", where, 1, mostFrames);
  const std::string name = text(json, "op", where);
  for (const auto& [known, read] : operations) {
    if (name == known) return {frame, read(json, where, robots)};
  }
  throw Malformed(where + ".op \"" + name + "\" is not a known operation");
}

Trace traceFrom(const Json& json) {
  Trace trace;
  trace.name = text(json, "name", "the trace");
  trace.frames = wholeNumber(json, "frames", "the trace", 0, mostFrames);
  if (json.contains("naive_every")) {
    trace.naiveEvery = wholeNumber(json, "naive_every", "the trace", 1, mostFrames);
  }
  if (const auto crash = json.find("crash"); crash != json.end() && !crash->is_null()) {
    trace.crashFrame = wholeNumber(*crash, "frame", "crash", 1, mostFrames);
  }
  const Json& ball = member(json, "ball", "the trace");
  trace.ballX = number(ball, "x", "ball");
  trace.ballY = number(ball, "y", "ball");
  trace.ballFriction = number(ball, "friction", "ball");
  const Json& robots = member(json, "robots", "the trace");
  if (!robots.is_array() || robots.size() > mostRobots) {
    throw Malformed("robots must be a list of at most 64 robots");
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    trace.robots.push_back(robotFrom(robots[i], "robots[" + std::to_string(i) + "]"));
  }
  const Json& schedule = member(json, "schedule", "the trace");
  if (!schedule.is_array()) throw Malformed("schedule must be a list");
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    trace.schedule.push_back(
        operationFrom(schedule[i], "schedule[" + std::to_string(i) + "]", trace.robots.size()));
  }
  std::stable_sort(trace.schedule.begin(), trace.schedule.end(),
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
    if (got < 0) return failure(ErrorCode::ParseError, "The gzip data are damaged.", path);
    if (got == 0) break;
    content.append(buffer.data(), static_cast<std::size_t>(got));
    if (content.size() > mostBytes) {
      return failure(ErrorCode::Unsupported, "The recorded rows are larger than 1 GiB.", path);
    }
  }
  int state = Z_OK;
  gzerror(file.get(), &state);
  if (state != Z_OK && state != Z_STREAM_END) {
    return failure(ErrorCode::ParseError, "The gzip data are damaged or cut off.", path);
  }
  return content;
}

Result<void> readRows(Trace& trace, const std::string& path) {
  auto content = readGzip(path);
  if (!content) return tl::unexpected(content.error());
  const std::string_view all = *content;
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
  const auto text = readFile(jsonPath, mostTextBytes, "The trace");
  if (!text) return tl::unexpected(text.error());
  Trace trace;
  try {
    trace = traceFrom(Json::parse(*text));
  } catch (const std::exception& error) {
    return failure(ErrorCode::ParseError, std::string("Not a trace: ") + error.what() + ".",
                   jsonPath);
  }
  const std::string rows = jsonPath.substr(0, jsonPath.size() - extension.size()) + ".csv.gz";
  if (auto read = readRows(trace, rows); !read) return tl::unexpected(read.error());
  return trace;
}

}  // namespace pitchboard::link
