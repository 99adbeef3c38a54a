// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The INI file of a robot (system.md section 2): [Communication] no_player_robofei = n is its
// number. It is read as the published processes do (Python's ConfigParser): comments start with #
// or ;, names are case-insensitive, = or : separates name and value. Sections of a team are
// ignored; sections whose name begins with "Pitchboard" are ours (docs/robot-programs.md), and
// every mistake there is an error. Plain values; any thread.

#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

struct IniEntry {
  std::string section;
  std::string name;   ///< in lower case
  std::string value;  ///< without surrounding blanks and comment; may be empty
  int line = 0;       ///< from 1
};

/// The values of an INI file, in order.
struct IniFile {
  std::string source;  ///< name of the file, for errors
  std::vector<IniEntry> entries;

  /// Returns the last value of this name, as the published processes do; null if there is none.
  const IniEntry* find(std::string_view section, std::string_view name) const;
  /// Returns the context of an error: "robot.ini, line 3".
  std::string place(const IniEntry& entry) const;
};

/// Parses a text. Errors name `source` and the line.
Result<IniFile> iniFromText(std::string_view text, std::string_view source);
/// Reads a file.
Result<IniFile> readIniFile(const std::string& path);

/// Returns the number of the robot. Fails with InvalidArgument outside 1 to 64.
Result<RobotId> robotFromNumber(long long number);
Result<RobotId> robotFromIni(const IniFile& file);

}  // namespace pitchboard::link
