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

}  // namespace

struct MonitorBooks {
  using Robot = TeamMonitor::Robot;

  static Json written(const Robot& robot, const TextDecoder& current, WallTime zero) {
    Json json{{"number", robot.number},
              {"serial", robot.serial},
              {"address", robot.sender.address.value},
              {"port", robot.sender.port},
              {"last", fromZero(robot.last, zero)},
              {"messages", robot.messages},
              {"bytes", robot.bytes},
              {"recoveries", robot.recoveries},
              {"highestVolts", robot.highestVolts},
              {"hash", robot.lastHash},
              {"hashTime", fromZero(robot.lastHashTime, zero)}};
    if (robot.previousPort) json["previousPort"] = *robot.previousPort;
    if (robot.volts) json["volts"] = *robot.volts;
    Json& arrivals = json["arrivals"] = Json::array();
    for (const WallTime time : robot.arrivals.times()) arrivals.push_back(fromZero(time, zero));
    const SequenceStats::Counts counts = robot.sequence.counts();
    Json& sequence = json["sequence"] =
        Json{{"lost", counts.lost}, {"received", counts.received}};
    if (counts.last) sequence["last"] = *counts.last;
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
                    WallTime zero) {
    const Reader in(json, zero);
    Robot robot;
    robot.number = in.whole<int>("number");
    robot.serial = in.whole<std::uint64_t>("serial");
    robot.sender = {{in.whole<std::uint32_t>("address")}, in.whole<std::uint16_t>("port")};
    if (in.find("previousPort")) robot.previousPort = in.whole<std::uint16_t>("previousPort");
    robot.last = in.time("last");
    robot.messages = in.whole<std::uint64_t>("messages");
    robot.bytes = in.whole<std::uint64_t>("bytes");
    robot.recoveries = in.whole<std::uint64_t>("recoveries");
    robot.volts = in.number("volts");
    robot.highestVolts = in.number("highestVolts").value_or(0.0);
    robot.lastHash = in.whole<std::size_t>("hash");
    robot.lastHashTime = in.time("hashTime");
    each(in.find("arrivals"), mostWords, [&](std::size_t, const Json& time) {
      if (time.is_number_integer()) robot.arrivals.add(in.timeOf(time.get<std::int64_t>()));
    });
    if (const Json* sequence = in.find("sequence"); sequence && sequence->is_object()) {
      const Reader of(*sequence, zero);
      SequenceStats::Counts counts;
      if (of.find("last")) counts.last = of.whole<std::int64_t>("last");
      counts.lost = of.whole<std::uint64_t>("lost");
      counts.received = of.whole<std::uint64_t>("received");
      robot.sequence = SequenceStats(counts);
    }
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
      robot.words.push_back(
          word.is_string() ? word.get<std::string>().substr(0, ErrorTally::sampleBytes)
                           : std::string());
    });
    robot.decoder = current;
    if (const std::string text = in.text("profile"); !text.empty()) {
      if (auto profile = parseProfile(text, "profile")) {
        robot.decoder = std::make_shared<const TextDecoder>(std::move(*profile));
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
  return Json{{"serial", m_serial}, {"robots", std::move(robots)}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
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
      read.push_back(MonitorBooks::read(robot, m_decoder, zero));
    }
  }
  m_robots = std::move(read);
  m_serial = Reader(json, zero).whole<std::uint64_t>("serial");
  return {};
}

}  // namespace pitchboard::telemetry
