// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Formats what `listen` and `decode` print: a JSON object, or a line for people, per message. Pure
// functions; any thread.

#include <nlohmann/json.hpp>
#include <string>

#include <robotlink/live/live_watch.h>
#include <telemetry/referee/referee_json.h>

namespace pitchboard::cli {

using Json = nlohmann::ordered_json;

/// Returns "telemetry", "variables", "drawing" or "referee".
const char* typeOf(const link::LiveDatagram& datagram);
/// Returns whether the datagram could be decoded.
bool isGood(const link::LiveDatagram& datagram);
/// Returns the robot's name, such as "B1" or "Robot 1"; empty for number 0.
std::string nameOf(const RobotKey& robot, const link::Teams& teams);
/// Appends a JSON object: the members of `head`, then the content of a datagram (docs/live.md). If
/// it could not be decoded, "text" has its bytes as text.
void addMessageJson(std::string& out, Json head, const link::LiveDatagram& datagram,
                    const link::LiveOptions& options);
void addMessageLine(std::string& out, const link::LiveDatagram& datagram,
                    const link::LiveOptions& options);

/// Returns {"type": "health", "robot": 1, "name": "B1", "received": 900, "lost": 300, ...}
/// (docs/live.md).
Json healthJson(const telemetry::RobotStatus& robot, const std::string& name,
                telemetry::WallTime now);
/// Returns "B1: 900 received, 300 lost (25.0 %), 0 duplicates, 0 late".
std::string healthLine(const telemetry::RobotStatus& robot, const std::string& name);

/// Returns {"type": "variablesHealth", "robot": 1, "name": "B1", "received": 900, ...}
/// (docs/live.md).
Json healthJson(const link::SentStatus& sent, telemetry::WallTime now);
/// Returns "B1 variables: 205 from 192.168.0.1, 900 received, ...".
std::string healthLine(const link::SentStatus& sent);

/// Returns {"type": "topic", "topic": "/imu", "values": {"path": 1.5, ...}, ...} (docs/live.md).
Json topicJson(const link::LiveTopicMessage& message);
/// Returns "/imu  path 1.5  ...", with the first values.
std::string topicLine(const link::LiveTopicMessage& message);
/// Returns {"type": "topicsHealth", "source": "ws://robot3:8765", ...} (docs/live.md).
Json healthJson(const link::TopicSourceStatus& source, telemetry::WallTime now);
/// Returns "ws://robot3:8765: connected to NAME, 12 of 15 topics, 900 received, ...".
std::string healthLine(const link::TopicSourceStatus& source);

/// Returns the JSON as text; bytes that are not UTF-8 are replaced.
std::string dump(const Json& json);

/// Returns the seconds since 1970, rounded to microseconds.
double unixSeconds(telemetry::WallTime time);

}  // namespace pitchboard::cli
