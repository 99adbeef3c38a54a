// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A server of Foxglove's WebSocket protocol: programs such as Foxglove, Lichtblick and PlotJuggler
// connect and show the channels that it offers. A client can only read, and where playback is
// offered, play, pause, seek and set the speed. A thread of its own does the work; every function
// may be called from any thread and never waits for a client: each has a bounded queue, from which
// the oldest messages go. Times are ns since 1970.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/foxglove/foxglove_frames.h>
#include <telemetry/foxglove/foxglove_requests.h>
#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

struct FoxgloveServerOptions {
  Address bind{0x7f000001};   ///< this computer only
  std::uint16_t port = 8765;  ///< 0: a free one
  std::string name;           ///< shown by clients
  std::string sessionId;      ///< another one for each run, so that clients begin anew
  /// The first and last moment, if clients may control the playback. It is offered to those with
  /// the newer subprotocol (foxgloveSubprotocols).
  std::optional<std::pair<std::uint64_t, std::uint64_t>> playback;
  /// Called on the server's thread.
  std::function<void(const FoxglovePlaybackControl&)> control;
  std::size_t queueBytes = std::size_t{8} << 20;  ///< that wait for one client
  std::size_t maxClients = 32;                    ///< more are refused
};

struct FoxgloveServerStatus {
  std::size_t clients = 0;
  std::uint64_t dropped = 0;  ///< messages for which a client's queue had no room
};

class FoxgloveServer {
 public:
  /// Listens. Fails with SystemError if the port or the address cannot be used.
  static Result<std::unique_ptr<FoxgloveServer>> start(const FoxgloveServerOptions& options);
  ~FoxgloveServer();  ///< closes all connections
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  std::uint16_t port() const;

  /// Offers a channel. Its id must not have been another channel's before.
  void advertise(FoxgloveChannel channel);
  /// Takes a channel back; nobody is subscribed to it any more.
  void unadvertise(std::uint32_t channel);
  /// Sends a message to everybody who subscribed to the channel.
  void send(std::uint32_t channel, std::uint64_t logTime, std::string_view payload);
  /// The same, and whoever subscribes later gets the last one at once. `payload` makes the message:
  /// during the call if there is a client, otherwise on the server's thread when somebody
  /// subscribes, or never. It must own what it needs.
  void sendKept(std::uint32_t channel, std::uint64_t logTime, std::function<std::string()> payload);
  /// Tells the present time of what is shown.
  void setTime(std::uint64_t time);
  /// Tells how the playback goes on, if it was offered.
  void setPlayback(const FoxglovePlaybackState& state);

  FoxgloveServerStatus status() const;

 private:
  struct Impl;
  explicit FoxgloveServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
