// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What listen and decode print: one JSON object, or one line for people, per message.

#include <nlohmann/json.hpp>
#include <string>

#include <robotlink/live/live_watch.h>
#include <telemetry/wire/referee_json.h>

namespace pitchboard::cli {

using Json = nlohmann::ordered_json;

/// "telemetry", "variables", "drawing" or "referee".
const char* typeOf(const link::LiveDatagram& datagram);
/// It could be read.
bool isGood(const link::LiveDatagram& datagram);
/// As everywhere: "B1", "Robot 1"; empty for number 0.
std::string nameOf(const RobotKey& robot, const link::Teams& teams);
/// What a datagram says (docs/live.md). What stands in it when it could not be read is "text".
Json messageJson(const link::LiveDatagram& datagram, const link::LiveOptions& options);
std::string messageLine(const link::LiveDatagram& datagram, const link::LiveOptions& options);

/// {"type": "health", "robot": 1, "name": "B1", "received": 900, "lost": 300, ...}: docs/live.md.
Json healthJson(const telemetry::RobotStatus& robot, const std::string& name,
                telemetry::WallTime now);
/// "B1: 900 received, 300 lost (25.0 %), 0 twice, 0 late"
std::string healthLine(const telemetry::RobotStatus& robot, const std::string& name);

/// {"type": "variablesHealth", "robot": 1, "name": "B1", "received": 900, ...}: docs/live.md.
Json healthJson(const link::SentStatus& sent, telemetry::WallTime now);
/// "B1 variables: 205 from 192.168.0.1, 900 received, ..."
std::string healthLine(const link::SentStatus& sent);

/// Text of any bytes: what is not UTF-8 is replaced.
std::string dump(const Json& json);

/// Seconds since 1970 with microseconds.
double unixSeconds(telemetry::WallTime time);

}  // namespace pitchboard::cli
