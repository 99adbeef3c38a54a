// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_monitor_snapshot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include <base/lenient_json.h>

#include <telemetry/formats/profile_names.h>

namespace pitchboard::telemetry {
namespace {

using MonitorJson = nlohmann::json;
using lenient::each;
using lenient::member;
using lenient::number;
using lenient::whole;

constexpr std::size_t maxTexts = DecodedText::maxValues;

std::int64_t fromZero(WallTime time, WallTime zero) {
  return (time - zero).count();
}

/// Of more than a century from zero none is right, and sums of them would not fit.
WallTime timeOf(std::int64_t nanoseconds, WallTime zero) {
  constexpr Duration century = std::chrono::hours(24 * 36'525);
  return zero + std::clamp(Duration(nanoseconds), -century, century);
}

WallTime timeAt(const MonitorJson& object, const char* key, WallTime zero) {
  return timeOf(whole<std::int64_t>(object, key), zero);
}

MonitorJson sequenceJson(const SequenceStats::Counts& counts) {
  MonitorJson json{{"bits", counts.bits},
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

SequenceStats sequenceFrom(const MonitorJson* json) {
  SequenceStats::Counts counts;
  if (json == nullptr || !json->is_object()) return SequenceStats(counts);
  const auto count = [json](const char* key) { return whole<std::uint64_t>(*json, key); };
  counts.bits = whole<int>(*json, "bits");
  if (counts.bits != 8 && counts.bits != 16 && counts.bits != 32) counts.bits = 0;
  if (member(*json, "newest")) counts.newest = count("newest");
  counts.highest = count("highest");
  counts.seen = count("seen");
  counts.span = count("span");
  counts.received = count("received");
  counts.lost = count("lost");
  counts.duplicates = count("duplicates");
  counts.late = count("late");
  counts.restarts = count("restarts");
  return SequenceStats(counts);
}

}  // namespace

/// The profile of robots whose saved state names none: that of their team.
class UsualProfiles {
 public:
  UsualProfiles(const Profile& profile, const MonitorOptions& options)
      : m_profile(profile), m_options(options), m_decoders(std::max<std::size_t>(1, teams())) {}

  const Profile& of(int team) const {
    if (team == simulatedTeam) return m_published;
    return teams() == 0 ? m_profile : m_options.teams[placeOf(team)].profile;
  }
  std::shared_ptr<const TextDecoder> decoderOf(int team) {
    std::shared_ptr<const TextDecoder>& decoder =
        team == simulatedTeam ? m_simulated : m_decoders[placeOf(team)];
    if (!decoder) decoder = std::make_shared<const TextDecoder>(of(team), whereOf(team));
    return decoder;
  }
  std::size_t teams() const { return m_options.teams.size(); }
  Surroundings whereOf(int team) const {
    Surroundings where = m_options.field;
    if (teams() > 0 && team != simulatedTeam)
      where.attacksLeft = m_options.teams[placeOf(team)].attacksLeft;
    return where;
  }

 private:
  std::size_t placeOf(int team) const {
    const auto index = static_cast<std::size_t>(std::max(team, 1)) - 1;
    return teams() == 0 ? 0 : std::min(index, teams() - 1);
  }

  const Profile& m_profile;
  const Profile m_published = publishedProfile();
  const MonitorOptions& m_options;
  std::shared_ptr<const TextDecoder> m_simulated;
  std::vector<std::shared_ptr<const TextDecoder>> m_decoders;  // by team, made when wanted
};

struct MonitorSnapshot {
  using Robot = TeamMonitor::Robot;

  static MonitorJson written(const Robot& robot, const UsualProfiles& usual, WallTime zero) {
    MonitorJson json{
        {"team", robot.key.team},         {"number", robot.key.number},
        {"sender", robot.key.sender},     {"address", robot.sender.address.value},
        {"port", robot.sender.port},      {"last", fromZero(robot.last, zero)},
        {"messages", robot.messages},     {"bytes", robot.bytes},
        {"recoveries", robot.recoveries}, {"offline", robot.offline.count()},
        {"duplicates", robot.duplicates}, {"highestVolts", robot.highestVolts},
        {"hash", robot.lastHash},         {"hashTime", fromZero(robot.lastHashTime, zero)}};
    if (robot.previous) {
      json["previous"] =
          MonitorJson{{"address", robot.previous->address.value}, {"port", robot.previous->port}};
    }
    for (const Robot::Other& other : robot.others) {
      json["others"].push_back(MonitorJson{{"address", other.sender.address.value},
                                           {"port", other.sender.port},
                                           {"last", fromZero(other.last, zero)}});
    }
    if (robot.volts) json["volts"] = *robot.volts;
    if (robot.charge) json["charge"] = *robot.charge;
    MonitorJson& arrivals = json["arrivals"] = MonitorJson::array();
    for (const WallTime time : robot.arrivals.times()) arrivals.push_back(fromZero(time, zero));
    json["sequence"] = sequenceJson(robot.sequence.counts());
    json["previousSequence"] = sequenceJson(robot.previousSequence.counts());
    MonitorJson& errors = json["errors"] = MonitorJson::array();
    for (std::size_t i = 0; i < textErrorCount; ++i) {
      errors.push_back(robot.errors.count(static_cast<TextError>(i)));
    }
    json["errorMessages"] = robot.errors.messages();
    MonitorJson& processes = json["processes"] = MonitorJson::array();
    for (const Robot::Process& process : robot.processes) {
      processes.push_back(MonitorJson{{"p", process.filter.probability()},
                                      {"known", process.known},
                                      {"since", fromZero(process.since, zero)}});
    }
    // NaN becomes null.
    json["values"] = robot.values;
    json["words"] = robot.texts;
    if (!robot.extras.empty()) json["extras"] = robot.extras;
    // It may have said nothing since the profile was changed.
    if (robot.decoder && !(robot.decoder->profile() == usual.of(robot.key.team))) {
      json["profile"] = profileText(robot.decoder->profile());
    }
    return json;
  }

  static Robot read(const MonitorJson& json, UsualProfiles& usual, WallTime zero) {
    Robot robot;
    robot.key = keyFrom(json, usual.teams());
    robot.sender = senderFrom(json);
    if (const MonitorJson* previous = member(json, "previous"))
      robot.previous = senderFrom(*previous);
    robot.last = timeAt(json, "last", zero);
    robot.messages = whole<std::uint64_t>(json, "messages");
    robot.bytes = whole<std::uint64_t>(json, "bytes");
    robot.recoveries = whole<std::uint64_t>(json, "recoveries");
    robot.offline = Duration(whole<std::int64_t>(json, "offline"));
    robot.duplicates = whole<std::uint64_t>(json, "duplicates");
    each(json, "others", maxTexts, [&](std::size_t, const MonitorJson& other) {
      if (!other.is_object()) return;
      robot.others.push_back({senderFrom(other), timeAt(other, "last", zero)});
    });
    robot.volts = number(json, "volts");
    robot.highestVolts = number(json, "highestVolts").value_or(0.0);
    robot.charge = number(json, "charge");
    robot.lastHash = whole<std::size_t>(json, "hash");
    robot.lastHashTime = timeAt(json, "hashTime", zero);
    each(json, "arrivals", maxTexts, [&](std::size_t, const MonitorJson& time) {
      if (time.is_number_integer()) robot.arrivals.add(timeOf(time.get<std::int64_t>(), zero));
    });
    robot.sequence = sequenceFrom(member(json, "sequence"));
    robot.previousSequence = sequenceFrom(member(json, "previousSequence"));
    std::uint64_t mistakes = 0;  // what 0.8 counted
    each(json, "errors", textErrorCount, [&](std::size_t i, const MonitorJson& count) {
      if (!count.is_number_unsigned()) return;
      robot.errors.add(static_cast<TextError>(i), count.get<std::uint64_t>());
      mistakes += count.get<std::uint64_t>();
    });
    robot.errors.addMessages(
        member(json, "errorMessages") ? whole<std::uint64_t>(json, "errorMessages") : mistakes);
    each(json, "processes", processCount, [&](std::size_t i, const MonitorJson& process) {
      if (!process.is_object()) return;
      robot.processes[i] = {ProcessFilter(number(process, "p").value_or(0.5)),
                            lenient::flag(process, "known"), timeAt(process, "since", zero)};
    });
    each(json, "values", maxTexts, [&](std::size_t, const MonitorJson& value) {
      robot.values.push_back(value.is_number() ? value.get<double>()
                                               : std::numeric_limits<double>::quiet_NaN());
    });
    each(json, "words", maxTexts, [&](std::size_t, const MonitorJson& entry) {
      robot.texts.push_back(entry.is_string()
                                ? entry.get<std::string>().substr(0, ErrorTally::sampleBytes)
                                : std::string());
    });
    each(json, "extras", DecodedText::maxExtras, [&](std::size_t, const MonitorJson& key) {
      robot.extras.push_back(key.is_string()
                                 ? key.get<std::string>().substr(0, profile_names::maxNameBytes)
                                 : std::string());
    });
    robot.decoder = usual.decoderOf(robot.key.team);
    if (const std::string text = lenient::text(json, "profile"); !text.empty()) {
      if (auto profile = parseProfile(text, "profile")) {
        robot.decoder =
            std::make_shared<const TextDecoder>(std::move(*profile), usual.whereOf(robot.key.team));
      }
    }
    return robot;
  }

  static RobotKey keyFrom(const MonitorJson& json, std::size_t teams) {
    const int received = whole<int>(json, "number");
    if (member(json, "team") != nullptr) {
      return {whole<int>(json, "team"), received, whole<int>(json, "sender")};
    }
    // 0.8 had one number for place and robot where there were several teams.
    constexpr int step = 1000;
    const int place = teams > 1 ? received / step + 1 : static_cast<int>(teams);
    return {place, teams > 1 ? received % step : received, whole<int>(json, "slot")};
  }

  static Sender senderFrom(const MonitorJson& json) {
    return {{whole<std::uint32_t>(json, "address")}, whole<std::uint16_t>(json, "port")};
  }
};

std::string TeamMonitor::robotsText(WallTime zero) const {
  MonitorJson robots = MonitorJson::array();
  const UsualProfiles usual(m_profile, m_options);
  for (const Robot& robot : m_robots) {
    robots.push_back(MonitorSnapshot::written(robot, usual, zero));
  }
  return MonitorJson{{"robots", std::move(robots)}}.dump(-1, ' ', false,
                                                         MonitorJson::error_handler_t::replace);
}

Result<void> TeamMonitor::restoreRobots(std::string_view text, WallTime zero) {
  const MonitorJson json = lenient::parsed<MonitorJson>(text);
  const MonitorJson* robots = json.is_object() ? member(json, "robots") : nullptr;
  if (robots == nullptr || !robots->is_array()) {
    return failure(ErrorCode::ParseError, "This is not a saved state of live robots.");
  }
  std::vector<Robot> read;
  const std::size_t most = maxPlaces(m_options);
  read.reserve(2 * most);  // to come and there
  UsualProfiles usual(m_profile, m_options);
  for (const MonitorJson& robot : *robots) {
    if (!robot.is_object() || read.size() == most) continue;
    Robot one = MonitorSnapshot::read(robot, usual, zero);
    const RobotKey& key = one.key;
    const bool possible =
        key.number >= 1 && key.number <= TextDecoder::maxRobot && key.sender >= 0 &&
        key.sender < static_cast<int>(most) && key.team >= 0 &&
        (static_cast<std::size_t>(key.team) <= m_options.teams.size() || key.team == simulatedTeam);
    if (possible) read.push_back(std::move(one));
  }
  m_robots = std::move(read);
  return {};
}

}  // namespace pitchboard::telemetry
