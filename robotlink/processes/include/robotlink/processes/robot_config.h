// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The INI file of a robot (system.md section 2): [Communication] no_player_robofei = n gives its
// number. As the published processes read it (Python's ConfigParser): comments start with # or ;,
// names of values in any case, = or : between name and value. A team's file holds much that means
// nothing here; sections whose name begins with "Pitchboard" are ours (docs/robot-programs.md), and
// there nothing is passed over in silence.

#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

struct IniEntry {
  std::string section;
  std::string name;   ///< in lower case
  std::string value;  ///< without blanks and comment; may be empty
  int line = 0;       ///< from 1
};

/// The lines of an INI file that have a name and a value, in their order.
struct IniFile {
  std::string source;  ///< for messages
  std::vector<IniEntry> entries;

  /// The last one wins, as in the published processes; nullptr when there is none.
  const IniEntry* find(std::string_view section, std::string_view name) const;
  /// "robot.ini, line 3", the context of an error.
  std::string place(const IniEntry& entry) const;
};

/// Errors name `source` and the line.
Result<IniFile> iniFromText(std::string_view text, std::string_view source);
/// Reads the file.
Result<IniFile> readIniFile(const std::string& path);

/// InvalidArgument, in words, for a number outside 1..64.
Result<RobotId> robotFromNumber(long long number);
Result<RobotId> robotFromIni(const IniFile& file);

}  // namespace pitchboard::link
