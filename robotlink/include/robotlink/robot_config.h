// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The INI file of a robot (SYSTEM.md section 2): [Communication] no_player_robofei = n gives its
// number. As the published processes read it (Python's ConfigParser): comments start with # or ;,
// names of values in any case, = or : between name and value.

#include <string>
#include <string_view>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

/// Numbers of robots that have a blackboard, telemetry port and team.
inline constexpr int highestRobotNumber = 64;

/// InvalidArgument, in words, for a number outside 1..64.
Result<RobotId> robotFromNumber(long long number);

/// Errors name `source` and the line.
Result<RobotId> robotFromIni(std::string_view text, std::string_view source);
/// Reads the file.
Result<RobotId> robotFromIniFile(const std::string& path);

}  // namespace pitchboard::link
