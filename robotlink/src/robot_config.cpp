// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/robot_config.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <fstream>

#include "spawn.h"

namespace pitchboard::link {
namespace {

constexpr std::string_view section = "Communication";
constexpr std::string_view key = "no_player_robofei";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\f\v";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

bool sameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

// A comment behind a value starts with a blank and a semicolon.
std::string_view withoutComment(std::string_view value) {
  for (std::size_t at = value.find(';'); at != std::string_view::npos;
       at = value.find(';', at + 1)) {
    if (at == 0 || value[at - 1] == ' ' || value[at - 1] == '\t') return value.substr(0, at);
  }
  return value;
}

std::string place(std::string_view source, int line) {
  return std::string(source) + ", line " + std::to_string(line);
}

Result<RobotId> parseNumber(std::string_view text, const std::string& where) {
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return failure(ErrorCode::ParseError,
                   "'" + std::string(text.substr(0, 40)) + "' is not the number of a robot", where);
  }
  Result<RobotId> robot = robotFromNumber(number);
  if (!robot) robot.error().context = where;
  return robot;
}

}  // namespace

Result<RobotId> robotFromNumber(long long number) {
  if (number >= 1 && number <= highestRobotNumber) return RobotId{static_cast<int>(number)};
  return failure(ErrorCode::InvalidArgument,
                 "there is no robot " + std::to_string(number) + "; robots have numbers from 1 to " +
                     std::to_string(highestRobotNumber));
}

Result<RobotId> robotFromIni(std::string_view text, std::string_view source) {
  bool inSection = false;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t newline = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, newline));
    text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
    if (line.empty() || line.front() == '#' || line.front() == ';') continue;
    if (line.front() == '[') {
      const std::size_t end = line.find(']');
      if (end == std::string_view::npos) {
        return failure(ErrorCode::ParseError, "a section's name has no ']'", place(source, number));
      }
      inSection = line.substr(1, end - 1) == section;
      continue;
    }
    const std::size_t equals = line.find_first_of("=:");
    if (!inSection || equals == std::string_view::npos) continue;
    if (sameName(trimmed(line.substr(0, equals)), key)) {
      return parseNumber(trimmed(withoutComment(line.substr(equals + 1))), place(source, number));
    }
  }
  return failure(ErrorCode::NotFound,
                 "gives no robot number; it needs the line 'no_player_robofei = 1' below "
                 "'[Communication]'",
                 std::string(source));
}

Result<RobotId> robotFromIniFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const int reason = errno;
  if (!file) return failure(ErrorCode::NotFound, "cannot be read: " + systemReason(reason), path);
  std::string text;
  // Not by iterator: that throws when the path is a folder.
  for (char buffer[4096]; file.read(buffer, sizeof buffer) || file.gcount() > 0;) {
    text.append(buffer, static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) {
    return failure(ErrorCode::SystemError, "cannot be read; is it a text file?", path);
  }
  return robotFromIni(text, path);
}

}  // namespace pitchboard::link
