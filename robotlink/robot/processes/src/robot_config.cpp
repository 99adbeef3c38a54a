// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/byte_sizes.h>
#include <robotlink/processes/robot_config.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include <base/read_file.h>
#include <base/system_reason.h>
#include <base/try.h>

namespace pitchboard::link {
namespace {

constexpr std::string_view ourSections = "Pitchboard";
constexpr std::size_t maxConfigBytes = mebibyte;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\f\v";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// A comment behind a value starts with a blank and a semicolon.
std::string_view withoutComment(std::string_view value) {
  for (std::size_t at = value.find(';'); at != std::string_view::npos;
       at = value.find(';', at + 1)) {
    if (at == 0 || value[at - 1] == ' ' || value[at - 1] == '\t') return value.substr(0, at);
  }
  return value;
}

std::string placeOf(std::string_view source, int line) {
  return std::string(source) + ", line " + std::to_string(line);
}

}  // namespace

Result<RobotId> robotFromNumber(long long number) {
  if (number >= 1 && number <= highestRobotNumber) return RobotId{static_cast<int>(number)};
  return failure(ErrorCode::InvalidArgument, "there is no robot " + std::to_string(number) +
                                                 "; robots have numbers from 1 to " +
                                                 std::to_string(highestRobotNumber));
}

const IniEntry* IniFile::find(std::string_view section, std::string_view name) const {
  const auto found = std::find_if(entries.rbegin(), entries.rend(), [&](const IniEntry& entry) {
    return entry.section == section && entry.name == name;
  });
  return found == entries.rend() ? nullptr : &*found;
}

std::string IniFile::place(const IniEntry& entry) const {
  return placeOf(source, entry.line);
}

// Read by hand, because the packaged readers do not read what Python's ConfigParser reads: libinih
// cuts every line after 199 characters (a command line may be longer) and tells of one wrong line
// only, which may be the team's own; the others know no ':' between name and value, or no lines.
Result<IniFile> iniFromText(std::string_view text, std::string_view source) {
  IniFile file{std::string(source), {}};
  std::string section;
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
        return failure(ErrorCode::ParseError, "a section name needs a closing ']'",
                       placeOf(source, number));
      }
      section = line.substr(1, end - 1);
      continue;
    }
    const std::size_t equals = line.find_first_of("=:");
    if (equals == std::string_view::npos || equals == 0) {
      if (!section.starts_with(ourSections)) continue;
      return failure(
          ErrorCode::ParseError,
          "'" + std::string(line.substr(0, 40)) + "' does not have the form 'name = value'",
          placeOf(source, number));
    }
    file.entries.push_back({section, lower(trimmed(line.substr(0, equals))),
                            std::string(trimmed(withoutComment(line.substr(equals + 1)))), number});
  }
  return file;
}

Result<IniFile> readIniFile(const std::string& path) {
  const auto text = TRY(readFile(path, maxConfigBytes));
  return iniFromText(text, path);
}

Result<RobotId> robotFromIni(const IniFile& file) {
  const IniEntry* entry = file.find("Communication", "no_player_robofei");
  if (!entry) {
    return failure(ErrorCode::NotFound,
                   "gives no robot number; it needs the line 'no_player_robofei = 1' below "
                   "'[Communication]'",
                   file.source);
  }
  const std::string& text = entry->value;
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    return failure(ErrorCode::ParseError,
                   "'" + text.substr(0, 40) + "' is not the number of a robot", file.place(*entry));
  }
  Result<RobotId> robot = robotFromNumber(number);
  if (!robot) robot.error().context = file.place(*entry);
  return robot;
}

}  // namespace pitchboard::link
