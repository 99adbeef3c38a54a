// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/group_attributes.h>

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include <base/lined_json.h>

namespace pitchboard::telemetry {
namespace {

/// Calls `visit` with the name and the place of each fact.
template <class Facts, class Visit>
void eachRobotFact(Facts& robot, Visit visit) {
  visit("attached", robot.attached);
  visit("behaviour", robot.behaviour);
  visit("field_of_view", robot.fieldOfView_deg);
  visit("former_names", robot.formerNames);
  visit("imu180", robot.imuStartsAt180);
  visit("key", robot.boardKey);
  visit("link", robot.linkOf);
  visit("live", robot.live);
  visit("name", robot.name);
  visit("number", robot.number);
  visit("order", robot.order);
  visit("place", robot.place);
  visit("profile", robot.profile);
  visit("programs", robot.programs);
  visit("radius", robot.radius_m);
  visit("rate", robot.rate_hz);
  visit("recorded", robot.recordedBy);
  visit("robot", robot.slot);
  visit("sender", robot.sender);
  visit("sent", robot.sentFrom);
  visit("shirt", robot.shirt);
  visit("team", robot.team);
  visit("team_name", robot.teamName);
  visit("team_number", robot.teamNumber);
  visit("timeout", robot.timeout_s);
  visit("uid", robot.uid);
  visit("vision_range", robot.visionRange_m);
  visit("was", robot.was);
}

template <class Facts, class Visit>
void eachMatchFact(Facts& match, Visit visit) {
  visit("physics", match.physics);
  visit("seed", match.seed);
  visit("tick_rate", match.tickRate_hz);
}

constexpr std::array<std::pair<const char*, double BatteryVolts::*>, 3> batteryNames{
    {{"battery_full", &BatteryVolts::full},
     {"battery_low", &BatteryVolts::low},
     {"battery_empty", &BatteryVolts::empty}}};

struct Writer {
  GroupAttributes& out;

  void operator()(const char* name, const std::string& text) const {
    if (!text.empty()) out[name] = text;
  }
  void operator()(const char* name, const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    (*this)(name, text);
  }
  void operator()(const char* name, bool is) const {
    if (is) out[name] = "1";
  }
  void operator()(const char* name, int number) const {
    if (number != 0) out[name] = std::to_string(number);
  }
  void operator()(const char* name, RobotUid uid) const {
    if (uid != RobotUid{}) out[name] = std::to_string(uid.value);
  }
  template <class Value>
  void operator()(const char* name, const std::optional<Value>& value) const {
    if (value) out[name] = textOf(*value);
  }

  static std::string textOf(bool is) { return is ? "1" : "0"; }
  static std::string textOf(int number) { return std::to_string(number); }
  static std::string textOf(std::uint64_t number) { return std::to_string(number); }
  static std::string textOf(double number) { return shortest(number); }
  static std::string textOf(TeamColor team) { return std::string(info(team).name); }
  static std::string textOf(const RobotOrder& order) {
    const RobotKey& robot = order.robot;
    return textOf(order.isTheirs) + " " + textOf(robot.team) + " " + textOf(robot.number) + " " +
           textOf(robot.sender);
  }
};

/// Reads a whole text, or leaves `value` as it is.
template <class Number>
bool readNumber(std::string_view text, Number& value) {
  Number read{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (text.empty() || code != std::errc() || end != text.data() + text.size()) return false;
  value = read;
  return true;
}

struct Reader {
  const GroupAttributes& in;
  bool& any;  // whether one of the facts is there

  void operator()(const char* name, auto& value) const {
    const auto found = in.find(name);
    if (found != in.end() && read(found->second, value)) any = true;
  }

  static bool read(const std::string& text, std::string& value) {
    value = text;
    return true;
  }
  static bool read(const std::string& text, std::vector<std::string>& lines) {
    std::istringstream all(text);
    for (std::string line; std::getline(all, line);) lines.push_back(line);
    return true;
  }
  static bool read(std::string_view text, bool& value) {
    value = text == "1";
    return true;
  }
  static bool read(std::string_view text, int& value) {
    return !text.starts_with('-') && readNumber(text, value);
  }
  static bool read(std::string_view text, std::uint64_t& value) { return readNumber(text, value); }
  static bool read(std::string_view text, double& value) {
    double number = 0.0;
    if (!readNumber(text, number) || !std::isfinite(number)) return false;
    value = number;
    return true;
  }
  static bool read(std::string_view text, RobotUid& uid) { return readNumber(text, uid.value); }
  static bool read(std::string_view text, RobotOrder& order) {
    std::array<int, 4> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int& number : numbers) {
      if (at != end && *at == ' ') ++at;
      const auto [next, code] = std::from_chars(at, end, number);
      if (code != std::errc()) return false;
      at = next;
    }
    order = {numbers[0] != 0, {numbers[1], numbers[2], numbers[3]}};
    return true;
  }
  static bool read(std::string_view text, TeamColor& team) {
    const auto named = teamColorNamed(text);
    if (named) team = *named;
    return named.has_value();
  }
  template <class Value>
  static bool read(const std::string& text, std::optional<Value>& value) {
    Value made{};
    if (!read(text, made)) return false;
    value = made;
    return true;
  }
};

}  // namespace

GroupAttributes attributesOf(const GroupInfo& group) {
  GroupAttributes out;
  if (group.match) eachMatchFact(*group.match, Writer{out});
  if (!group.robot) return out;
  eachRobotFact(*group.robot, Writer{out});
  if (const auto& battery = group.robot->battery) {
    for (const auto& [name, volts] : batteryNames) out[name] = shortest((*battery).*volts);
  }
  return out;
}

void readAttributes(const GroupAttributes& attributes, GroupInfo& group) {
  bool isRobot = false, isMatch = false, hasBattery = true;
  RobotFacts robot;
  eachRobotFact(robot, Reader{attributes, isRobot});
  BatteryVolts battery;
  for (const auto& [name, volts] : batteryNames) {
    const auto found = attributes.find(name);
    hasBattery =
        hasBattery && found != attributes.end() && Reader::read(found->second, battery.*volts);
  }
  if (hasBattery) robot.battery = battery;
  MatchFacts match;
  eachMatchFact(match, Reader{attributes, isMatch});
  group.robot = isRobot ? std::optional(std::move(robot)) : std::nullopt;
  group.match = isMatch ? std::optional(std::move(match)) : std::nullopt;
}

}  // namespace pitchboard::telemetry
