// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/session_checkpoint.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <base/base64.h>
#include <base/try.h>

#include "recorded_layout.h"

namespace pitchboard::link {
namespace {

// Longer than the time between two checkpoints.
constexpr double defaultReach = 2.5;  // s

}  // namespace

std::string checkpointToJson(const StateSegment& segment) {
  return nlohmann::ordered_json{
      {"time", static_cast<double>(segment.firstTick()) / segment.tickRate()},
      {"tick", segment.firstTick()},
      {"last_tick", segment.lastTick()},
      {"segment", toBase64(segment.encode())}}
      .dump();
}

Result<StateSegment> checkpointFromJson(std::string_view json) {
  const auto object = nlohmann::json::parse(json, nullptr, false);
  if (object.is_object()) {
    const auto found = object.find("segment");
    if (found != object.end() && found->is_string()) {
      const auto bytes = fromBase64(found->get_ref<const std::string&>());
      if (bytes) return StateSegment::decode(*bytes);
    }
  }
  return failure(ErrorCode::ParseError, "a checkpoint of the match cannot be read", "/checkpoints");
}

void appendCheckpoint(telemetry::SessionWriter& session, const StateSegment& segment) {
  session.appendJson(telemetry::SessionStream::Checkpoints,
                     static_cast<double>(segment.firstTick()) / segment.tickRate(),
                     checkpointToJson(segment));
}

Result<SessionCheckpoint> checkpointAt(const telemetry::SessionReader& session, double seconds) {
  const auto range = session.range();
  std::optional<double> time;
  std::string json;
  const auto look = [&](double from) {
    session.messages(telemetry::SessionStream::Checkpoints, {from, seconds + timeTolerance},
                     [&](double at, std::string_view message) {
                       if (!time || at >= *time) {
                         time = at;
                         json = message;
                       }
                       return true;
                     });
  };
  if (range) look(std::max(range->begin, seconds - defaultReach));
  if (range && !time) look(range->begin);
  if (!time) {
    return failure(ErrorCode::NotFound,
                   "this session has no state of a simulated match at that time; only simulated "
                   "matches can be continued exactly");
  }
  auto segment = TRY(checkpointFromJson(json));
  return SessionCheckpoint{*time, std::move(segment)};
}

}  // namespace pitchboard::link
