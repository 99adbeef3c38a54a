// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What listen and decode print: one JSON object, or one line for people, per message.

#include <nlohmann/json.hpp>
#include <string>

#include <telemetry/wire/datagram.h>
#include <telemetry/wire/gamecontroller.h>
#include <telemetry/wire/referee_json.h>
#include <telemetry/wire/team_monitor.h>
#include <telemetry/wire/text_decoder.h>

namespace pitchboard::cli {

using Json = nlohmann::ordered_json;

/// {"robot": 1, "values": {"X": 258, ...}, "errors": [...]}; "text" is added when there are errors.
/// `number`: of the robot in its team; `team`: its title, empty without setups.
Json telemetryJson(const telemetry::TextDecoder& decoder, const telemetry::DecodedText& message,
                   std::string_view datagram, int number, const std::string& team = {});
std::string telemetryLine(const telemetry::TextDecoder& decoder,
                          const telemetry::DecodedText& message, std::string_view datagram,
                          int number, const std::string& team = {});

/// {"type": "health", "robot": 1, "name": "B1", "received": 900, "lost": 300, ...}: docs/LIVE.md.
Json healthJson(const telemetry::RobotStatus& robot, const std::string& name,
                telemetry::WallTime now);
/// "B1: 900 received, 300 lost (25.0 %), 0 twice, 0 late"
std::string healthLine(const telemetry::RobotStatus& robot, const std::string& name);

std::string refereeLine(const telemetry::RefereePacket& packet);

/// Text of any bytes: what is not UTF-8 is replaced.
std::string dump(const Json& json);

/// Seconds since 1970 with microseconds.
double unixSeconds(telemetry::WallTime time);

}  // namespace pitchboard::cli
