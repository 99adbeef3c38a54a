// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A client of Foxglove's WebSocket protocol that only reads: it connects, and connects again for as
// long as it exists, passes on which channels a server has, subscribes to those that it is asked
// for, and passes on their messages. It never publishes, and sets no parameters. A thread of its
// own does all of it; the public functions may be called from any thread and never wait for the
// network.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <telemetry/foxglove/foxglove_address.h>
#include <telemetry/foxglove/foxglove_frames.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// A server has introduced itself: all its channels follow, and those of before are gone.
struct FoxgloveBegun {
  std::uint64_t session = 0;  ///< counts connections and the server's sessions, for subscribe()
  std::string server;         ///< its name
};
struct FoxgloveChannelsAdded {
  std::vector<FoxgloveChannel> channels;
};
struct FoxgloveChannelsRemoved {
  std::vector<std::uint32_t> channels;
};
struct FoxgloveReceived {
  std::uint32_t channel = 0;
  std::uint64_t logTime = 0;  ///< ns, by the server's clock
  WallTime arrival{};         ///< by the client's clock
  std::string payload;
};
/// The connection has ended; the client tries again.
struct FoxgloveEnded {};

/// What has happened, in order.
using FoxgloveEvent = std::variant<FoxgloveBegun, FoxgloveChannelsAdded, FoxgloveChannelsRemoved,
                                   FoxgloveReceived, FoxgloveEnded>;

enum class FoxgloveState : std::uint8_t {
  Connecting,
  Connected,  ///< the server has introduced itself
  Waiting     ///< for the next attempt
};

struct FoxgloveClientStatus {
  FoxgloveState state = FoxgloveState::Connecting;
  std::string server;       ///< name of the last server
  std::string subprotocol;  ///< of the present or last connection
  std::string problem;      ///< why there is no connection; empty while there is one
  std::string serverText;   ///< last warning or error that the server sent; empty: none
  std::uint64_t connections = 0;
  std::uint64_t messages = 0, bytes = 0;  ///< of messages that were passed on
  std::uint64_t dropped = 0;              ///< messages that were not taken in time
  std::uint64_t malformed = 0;  ///< frames that were left out, those that are too large included
  std::string malformedReason;  ///< of the last one
};

struct FoxgloveLimits {
  std::size_t frameBytes = std::size_t{32} << 20;   ///< larger frames are left out
  std::size_t textBytes = std::size_t{16} << 20;    ///< the same for text frames
  std::size_t queueBytes = std::size_t{64} << 20;   ///< of events that are not taken yet
  std::size_t channels = 2000;                      ///< of a server
  std::size_t schemaBytes = std::size_t{32} << 20;  ///< of all channels of a server together
  Duration answer = std::chrono::seconds(5);    ///< for each step until the server's first message
  Duration silence = std::chrono::seconds(15);  ///< then a server that does not answer is gone
  Duration firstRetry = std::chrono::milliseconds(500);  ///< doubles with each attempt, up to
  Duration lastRetry = std::chrono::seconds(10);
};

class FoxgloveClient {
 public:
  /// `now` stamps arrivals. `onEvent` is called when events can be taken that were not announced
  /// yet, or the state has changed; both are called on the client's thread and must not block.
  FoxgloveClient(FoxgloveAddress address, std::function<WallTime()> now,
                 std::function<void()> onEvent, FoxgloveLimits limits = {});
  /// Closes the connection, or gives up the attempt, at once.
  ~FoxgloveClient();
  FoxgloveClient(const FoxgloveClient&) = delete;
  FoxgloveClient& operator=(const FoxgloveClient&) = delete;

  /// Returns the events since the last call, oldest first.
  std::vector<FoxgloveEvent> take();
  /// Asks for the messages of channels. Does nothing if `session` is not FoxgloveBegun::session of
  /// the present one, or a channel has gone.
  void subscribe(std::uint64_t session, std::vector<std::uint32_t> channels);
  FoxgloveClientStatus status() const;
  const FoxgloveAddress& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
