// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session_checkpoint.h>

#include <algorithm>

namespace pitchboard::link {
namespace {

// Longer than the time between two checkpoints.
constexpr double usualReach = 2.5;      // s
constexpr double timeTolerance = 1e-6;  // s; file times are whole nanoseconds

}  // namespace

void appendCheckpoint(telemetry::SessionWriter& session, const StateSegment& segment) {
  session.appendCheckpoint(static_cast<double>(segment.firstTick()) / segment.tickRate(),
                           segment.encode());
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
  if (range) look(std::max(range->begin, seconds - usualReach));
  if (range && !time) look(range->begin);
  if (!time) {
    return failure(ErrorCode::NotFound,
                   "this session has no state of a simulated match at that time; only what was "
                   "recorded from a simulation can be entered again exactly");
  }
  const auto bytes = telemetry::sessionCheckpoint(json);
  if (!bytes) {
    return failure(ErrorCode::ParseError, "the state of the match at that time is damaged");
  }
  auto segment = StateSegment::decode(*bytes);
  if (!segment) return tl::unexpected(segment.error());
  return SessionCheckpoint{*time, std::move(*segment)};
}

}  // namespace pitchboard::link
