// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Receives datagrams on many UDP ports, on a thread of its own. It never sends, because leagues
// forbid it; a test checks that by the symbols of this library.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <telemetry/sockets/datagram.h>
#include <telemetry/sockets/live_clock.h>

namespace pitchboard::telemetry {

struct ReceiverOptions {
  Address bind{};                    ///< 0.0.0.0: all interfaces, unicast and broadcast
  std::vector<std::uint16_t> ports;  ///< see teamPorts(); 0 takes a free port (for tests)
  int receiveBufferBytes = 4 << 20;  ///< requested from the kernel for each port
  std::size_t maxDatagrams =
      1 << 16;  ///< datagrams that wait for take(); more are dropped and counted
  std::size_t maxBytes = 32U << 20;
  /// The clock that stamps datagrams; null: the receiver makes one.
  std::shared_ptr<const LiveClock> clock{};
  Duration retry =
      std::chrono::seconds(3);  ///< time between attempts to bind a port that is in use
  /// The program that listens on a port first keeps the datagrams that are sent to this computer
  /// alone. A later one gets broadcasts only (if `bind` is 0.0.0.0) until the first one ends.
  /// Otherwise the later program takes them away.
  bool yieldsToFirst = false;
};

/// Returns the robots' ports base + 1 to base + count, and the referee's. Fails with
/// InvalidArgument if one lies outside 1 to 65535, or if the referee's is among the robots'.
Result<std::vector<std::uint16_t>> livePorts(int base = 1240, int count = 16, int referee = 3838);

/// The state of one port.
struct PortStatus {
  std::uint16_t port = 0;
  bool bound = false;
  std::string problem;  ///< why it is not bound; empty if it is
  /// Another program was first: only broadcasts arrive (ReceiverOptions::yieldsToFirst).
  bool broadcastsOnly = false;
  /// Other programs that receive on this port, "pitchboard (process 4711)"; empty: none. Only known
  /// with ReceiverOptions::yieldsToFirst.
  std::string others;
  bool othersTakeAll = false;  ///< they also receive what is sent to this computer alone
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::uint64_t kernelDrops = 0;  ///< datagrams lost because the kernel's buffer was full
  std::uint64_t truncated = 0;
};

struct ReceiverStatus {
  std::vector<PortStatus> ports;  ///< in the order of the options
  std::uint64_t queueDrops = 0;   ///< datagrams that were not taken in time
  std::uint64_t kernelDrops() const;
  std::uint64_t datagrams() const;
};

/// Returns "1241–1256" and "3838" for the ports 1241 to 1256 and 3838.
std::vector<std::string> portRanges(std::vector<std::uint16_t> ports);
/// Returns sentences about the ports that other programs receive, too, and who gets what; empty if
/// there are none. `ignored` is a port where sharing does no harm, because everything that arrives
/// there is broadcast.
std::string sharedPortsText(const ReceiverStatus& status, std::optional<std::uint16_t> ignored);

/// The thread runs from construction to destruction. take(), status() and stop() may be called from
/// any thread.
class UdpReceiver {
 public:
  /// Starts receiving. `onReady` is called on the receiving thread when the first datagram of a
  /// batch waits; it must return at once, for example after posting an event. Ports that cannot be
  /// bound are no error: status() tells why, and they are tried again. Fails with SystemError if
  /// the system refuses epoll.
  static Result<std::unique_ptr<UdpReceiver>> start(ReceiverOptions options,
                                                    std::function<void()> onReady = {});
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  /// Moves all waiting datagrams into `batch`, which is cleared before. Waits at most `wait` for
  /// the first. Returns false if there was none or the receiver was stopped.
  bool take(DatagramBatch& batch, Duration wait = Duration::zero());
  ReceiverStatus status() const;
  /// Ends the thread. Waiting datagrams can still be taken.
  void stop();

 private:
  struct Impl;
  explicit UdpReceiver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
