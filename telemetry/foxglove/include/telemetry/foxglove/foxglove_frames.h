// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The frames of Foxglove's WebSocket protocol, as far as a program needs them that only reads:
// parses what servers send, and makes what asks them for messages. Both subprotocols have the same
// frames. Times are ns since 1970 by the server's clock. Pure functions; any thread.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

/// Programs with the Foxglove SDK know only the first, older ones only the second.
inline constexpr std::array<std::string_view, 2> foxgloveSubprotocols{"foxglove.sdk.v1",
                                                                      "foxglove.websocket.v1"};

/// The first message of a server.
struct FoxgloveServerInfo {
  std::string name;
  std::string sessionId;  ///< of a run of the server: ids of channels mean nothing in another one
};

/// What messages of a channel are. The words are those of MCAP.
struct FoxgloveChannel {
  std::uint32_t id = 0;
  std::string topic;
  std::string encoding;        ///< of the messages: "cdr", "json", "protobuf"
  std::string schemaName;      ///< "sensor_msgs/msg/Imu"
  std::string schema;          ///< text, or the bytes of a FileDescriptorSet
  std::string schemaEncoding;  ///< "ros2msg"; the usual one if the server does not say it
};

struct FoxgloveAdvertise {
  std::vector<FoxgloveChannel> channels;
  std::size_t refused = 0;  ///< channels that are not as they should be
  std::string reason{};     ///< what is wrong with the last of them
};

struct FoxgloveUnadvertise {
  std::vector<std::uint32_t> channels;
};

struct FoxgloveStatusText {
  int level = 0;  ///< 0: information, 1: warning, 2: error
  std::string text;
};

struct FoxgloveMessage {
  std::uint32_t subscription = 0;
  std::uint64_t logTime = 0;
  std::string_view payload;  ///< in the frame
};

/// A valid frame that is not needed.
struct FoxgloveOther {};

using FoxgloveFrame = std::variant<FoxgloveServerInfo, FoxgloveAdvertise, FoxgloveUnadvertise,
                                   FoxgloveStatusText, FoxgloveMessage, FoxgloveOther>;

/// Reads a text frame. Fails with ParseError, and says what is wrong.
Result<FoxgloveFrame> parseFoxgloveText(std::string_view json);
/// Reads a binary frame; the message refers to `bytes`. Fails with ParseError.
Result<FoxgloveFrame> parseFoxgloveBinary(std::string_view bytes);

/// Returns the text frame that asks for the messages of channels. Each pair is the subscription's
/// id, which the client chooses, and the channel's.
std::string foxgloveSubscribe(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs);

}  // namespace pitchboard::telemetry
