// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The other direction of <telemetry/foxglove/foxglove_frames.h>: parses what clients of Foxglove's
// WebSocket protocol ask, and makes what a server sends. Times are ns since 1970. Pure functions;
// any thread.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <base/result.h>
#include <telemetry/foxglove/foxglove_frames.h>

namespace pitchboard::telemetry {

/// Each pair is the subscription's id, which the client chooses, and the channel's.
struct FoxgloveSubscribe {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
};
struct FoxgloveUnsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
/// Play or pause, and perhaps seek first.
struct FoxglovePlaybackControl {
  bool plays = false;
  double speed = 1.0;  ///< times real time
  std::optional<std::uint64_t> seek{};
  std::string requestId;  ///< goes back with the state that follows from it
};
struct FoxglovePlaybackState {
  enum class Status : std::uint8_t { Playing, Paused, Buffering, Ended };
  Status status = Status::Paused;
  std::uint64_t time = 0;
  double speed = 1.0;
  bool didSeek = false;
  std::string requestId{};  ///< empty: nobody asked
};

using FoxgloveRequest =
    std::variant<FoxgloveSubscribe, FoxgloveUnsubscribe, FoxglovePlaybackControl, FoxgloveOther>;

/// Reads a text frame of a client. Fails with ParseError, and says what is wrong.
Result<FoxgloveRequest> parseFoxgloveRequest(std::string_view json);
/// Reads a binary frame of a client; requests other than playback control are FoxgloveOther.
Result<FoxgloveRequest> parseFoxgloveControl(std::string_view bytes);

/// Text frames of a server. `playback`: the first and last moment, if clients may control it.
std::string foxgloveServerInfo(
    const FoxgloveServerInfo& info,
    const std::optional<std::pair<std::uint64_t, std::uint64_t>>& playback);
std::string foxgloveAdvertise(std::span<const FoxgloveChannel> channels);
std::string foxgloveUnadvertise(std::span<const std::uint32_t> channels);
std::string foxgloveStatus(const FoxgloveStatusText& status);
/// Binary frames of a server.
std::string foxgloveMessageFrame(const FoxgloveMessage& message);
std::string foxgloveTimeFrame(std::uint64_t time);
std::string foxglovePlaybackFrame(const FoxglovePlaybackState& state);

}  // namespace pitchboard::telemetry
