// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_monitor_books.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::json;

constexpr std::size_t mostWords = DecodedText::maxValues;

std::int64_t fromZero(WallTime time, WallTime zero) {
  return (time - zero).count();
}

/// Reads members that may be missing or of another kind: they keep their defaults.
class Reader {
 public:
  Reader(const Json& object, WallTime zero) : m_object(object), m_zero(zero) {}

  const Json* find(const char* key) const {
    const auto found = m_object.find(key);
    return found == m_object.end() || found->is_null() ? nullptr : &*found;
  }
  template <class T>
  T whole(const char* key, T fallback = {}) const {
    const Json* value = find(key);
    if (value == nullptr || !value->is_number_integer()) return fallback;
    if (value->is_number_unsigned()) {
      const auto number = value->get<std::uint64_t>();
      return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
    }
    const auto number = value->get<std::int64_t>();
    return std::in_range<T>(number) ? static_cast<T>(number) : fallback;
  }
  std::optional<double> number(const char* key) const {
    const Json* value = find(key);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>())
                                                  : std::nullopt;
  }
  WallTime time(const char* key) const { return timeOf(whole<std::int64_t>(key)); }
  /// Of more than a century from zero none is right, and sums of them would not fit.
  WallTime timeOf(std::int64_t nanoseconds) const {
    constexpr Duration century = std::chrono::hours(24 * 36'525);
    return m_zero + std::clamp(Duration(nanoseconds), -century, century);
  }
  std::string text(const char* key) const {
    const Json* value = find(key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
  }

 private:
  const Json& m_object;
  WallTime m_zero;
};

Json sequenceJson(const SequenceStats::Counts& counts) {
  Json json{{"bits", counts.bits},
            {"highest", counts.highest},
            {"seen", counts.seen},
            {"span", counts.span},
            {"received", counts.received},
            {"lost", counts.lost},
            {"duplicates", counts.duplicates},
            {"late", counts.late},
            {"restarts", counts.restarts}};
  if (counts.newest) json["newest"] = *counts.newest;
  return json;
}

SequenceStats sequenceFrom(const Json* json, WallTime zero) {
  SequenceStats::Counts counts;
  if (json == nullptr || !json->is_object()) return SequenceStats(counts);
  const Reader in(*json, zero);
  counts.bits = in.whole<int>("bits");
  if (counts.bits != 8 && counts.bits != 16 && counts.bits != 32) counts.bits = 0;
  if (in.find("newest")) counts.newest = in.whole<std::uint64_t>("newest");
  counts.highest = in.whole<std::uint64_t>("highest");
  counts.seen = in.whole<std::uint64_t>("seen");
  counts.span = in.whole<std::uint64_t>("span");
  counts.received = in.whole<std::uint64_t>("received");
  counts.lost = in.whole<std::uint64_t>("lost");
  counts.duplicates = in.whole<std::uint64_t>("duplicates");
  counts.late = in.whole<std::uint64_t>("late");
  counts.restarts = in.whole<std::uint64_t>("restarts");
  return SequenceStats(counts);
}

}  // namespace

struct MonitorBooks {
  using Robot = TeamMonitor::Robot;

  static Json written(const Robot& robot, const TextDecoder& current, WallTime zero) {
    Json json{{"number", robot.number},
              {"slot", robot.slot},
              {"address", robot.sender.address.value},
              {"port", robot.sender.port},
              {"last", fromZero(robot.last, zero)},
              {"messages", robot.messages},
              {"bytes", robot.bytes},
              {"recoveries", robot.recoveries},
              {"duplicates", robot.duplicates},
              {"highestVolts", robot.highestVolts},
              {"hash", robot.lastHash},
              {"hashTime", fromZero(robot.lastHashTime, zero)}};
    if (robot.previous) {
      json["previous"] =
          Json{{"address", robot.previous->address.value}, {"port", robot.previous->port}};
    }
    if (robot.volts) json["volts"] = *robot.volts;
    Json& arrivals = json["arrivals"] = Json::array();
    for (const WallTime time : robot.arrivals.times()) arrivals.push_back(fromZero(time, zero));
    json["sequence"] = sequenceJson(robot.sequence.counts());
    json["previousSequence"] = sequenceJson(robot.previousSequence.counts());
    Json& errors = json["errors"] = Json::array();
    for (std::size_t i = 0; i < textErrorCount; ++i) {
      errors.push_back(robot.errors.count(static_cast<TextError>(i)));
    }
    Json& processes = json["processes"] = Json::array();
    for (const Robot::Process& process : robot.processes) {
      processes.push_back(Json{{"p", process.filter.probability()},
                               {"known", process.known},
                               {"since", fromZero(process.since, zero)}});
    }
    // NaN becomes null.
    json["values"] = robot.values;
    json["words"] = robot.words;
    // It may have said nothing since the profile was changed.
    if (robot.decoder && !(robot.decoder->profile() == current.profile())) {
      json["profile"] = profileText(robot.decoder->profile());
    }
    return json;
  }

  static Robot read(const Json& json, const std::shared_ptr<const TextDecoder>& current,
                    const Surroundings& field, WallTime zero) {
    const Reader in(json, zero);
    Robot robot;
    robot.number = in.whole<int>("number");
    robot.slot = in.whole<int>("slot");
    robot.sender = {{in.whole<std::uint32_t>("address")}, in.whole<std::uint16_t>("port")};
    if (const Json* previous = in.find("previous"); previous && previous->is_object()) {
      const Reader of(*previous, zero);
      robot.previous = {{of.whole<std::uint32_t>("address")}, of.whole<std::uint16_t>("port")};
    }
    robot.last = in.time("last");
    robot.messages = in.whole<std::uint64_t>("messages");
    robot.bytes = in.whole<std::uint64_t>("bytes");
    robot.recoveries = in.whole<std::uint64_t>("recoveries");
    robot.duplicates = in.whole<std::uint64_t>("duplicates");
    robot.volts = in.number("volts");
    robot.highestVolts = in.number("highestVolts").value_or(0.0);
    robot.lastHash = in.whole<std::size_t>("hash");
    robot.lastHashTime = in.time("hashTime");
    each(in.find("arrivals"), mostWords, [&](std::size_t, const Json& time) {
      if (time.is_number_integer()) robot.arrivals.add(in.timeOf(time.get<std::int64_t>()));
    });
    robot.sequence = sequenceFrom(in.find("sequence"), zero);
    robot.previousSequence = sequenceFrom(in.find("previousSequence"), zero);
    each(in.find("errors"), textErrorCount, [&](std::size_t i, const Json& count) {
      if (count.is_number_unsigned()) {
        robot.errors.add(static_cast<TextError>(i), count.get<std::uint64_t>());
      }
    });
    each(in.find("processes"), processCount, [&](std::size_t i, const Json& process) {
      if (!process.is_object()) return;
      const Reader of(process, zero);
      const Json* known = of.find("known");
      robot.processes[i] = {ProcessFilter(of.number("p").value_or(0.5)),
                            known && known->is_boolean() && known->get<bool>(), of.time("since")};
    });
    each(in.find("values"), mostWords, [&](std::size_t, const Json& value) {
      robot.values.push_back(value.is_number() ? value.get<double>()
                                               : std::numeric_limits<double>::quiet_NaN());
    });
    each(in.find("words"), mostWords, [&](std::size_t, const Json& word) {
      robot.words.push_back(word.is_string()
                                ? word.get<std::string>().substr(0, ErrorTally::sampleBytes)
                                : std::string());
    });
    robot.decoder = current;
    if (const std::string text = in.text("profile"); !text.empty()) {
      if (auto profile = parseProfile(text, "profile")) {
        robot.decoder = std::make_shared<const TextDecoder>(std::move(*profile), field);
      }
    }
    return robot;
  }

  template <class Visit>
  static void each(const Json* array, std::size_t most, const Visit& visit) {
    if (array == nullptr || !array->is_array()) return;
    for (std::size_t i = 0; i < std::min(array->size(), most); ++i) visit(i, (*array)[i]);
  }
};

std::string TeamMonitor::robotsText(WallTime zero) const {
  Json robots = Json::array();
  for (const Robot& robot : m_robots) {
    robots.push_back(MonitorBooks::written(robot, *m_decoder, zero));
  }
  return Json{{"robots", std::move(robots)}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<void> TeamMonitor::restoreRobots(std::string_view text, WallTime zero) {
  const Json json = Json::parse(
      text, [](int depth, Json::parse_event_t, Json&) { return depth <= 8; }, false);
  const auto robots = json.is_object() ? json.find("robots") : json.end();
  if (!json.is_object() || robots == json.end() || !robots->is_array()) {
    return failure(ErrorCode::ParseError, "This is no state of robots that were heard.");
  }
  std::vector<Robot> read;
  read.reserve(MonitorOptions::maxRobots);
  for (const Json& robot : *robots) {
    if (robot.is_object() && read.size() < MonitorOptions::maxRobots) {
      read.push_back(MonitorBooks::read(robot, m_decoder, m_options.field, zero));
    }
  }
  m_robots = std::move(read);
  return {};
}

}  // namespace pitchboard::telemetry
