// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Receives datagrams on many UDP ports in a thread of its own. It never sends: the league forbids
// it, and a test reads the symbols of this library to prove it.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/wire/datagram.h>
#include <telemetry/wire/live_clock.h>

namespace pitchboard::telemetry {

struct ReceiverOptions {
  Address bind{};                    ///< 0.0.0.0: every interface, unicast and broadcast
  std::vector<std::uint16_t> ports;  ///< see teamPorts(); 0 takes a free one (for tests)
  int receiveBufferBytes = 4 << 20;  ///< asked of the kernel, per port; it may give less
  std::size_t maxDatagrams =
      1 << 16;  ///< waiting for take(); what comes beyond is dropped, counted
  std::size_t maxBytes = 32U << 20;
  /// By which datagrams are stamped; null: one of the receiver's own.
  std::shared_ptr<const LiveClock> clock{};
  Duration retry = std::chrono::seconds(3);  ///< between attempts to bind a port that is taken
};

/// Ports base + 1 ... base + count of the robots, and the referee's. Error InvalidArgument when one
/// lies outside 1 to 65535 or the referee's is among the robots'.
Result<std::vector<std::uint16_t>> livePorts(int base = 1240, int count = 16, int referee = 3838);

/// How one port is doing.
struct PortStatus {
  std::uint16_t port = 0;
  bool bound = false;
  std::string problem;  ///< why it is not bound; empty when it is
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::uint64_t kernelDrops = 0;  ///< the kernel's buffer was full
  std::uint64_t truncated = 0;
};

struct ReceiverStatus {
  std::vector<PortStatus> ports;  ///< in the order of the options
  std::uint64_t queueDrops = 0;   ///< nobody took them in time
  std::uint64_t kernelDrops() const;
  std::uint64_t datagrams() const;
};

/// The thread starts in the constructor and ends in the destructor. take(), status() and stop() may
/// be called from any thread.
class UdpReceiver {
 public:
  /// `onReady` is called from the receiving thread whenever the first datagram of a batch waits; it
  /// must return at once (post an event, nothing else). Ports that cannot be bound are no error:
  /// status() has the reason, and they are tried again. Error SystemError when the thread's own
  /// means (epoll) are refused.
  static Result<std::unique_ptr<UdpReceiver>> start(ReceiverOptions options,
                                                    std::function<void()> onReady = {});
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  /// Swaps everything that waits into `batch` (cleared before). Waits at most `wait` for the first;
  /// false when there was nothing or the receiver was stopped.
  bool take(DatagramBatch& batch, Duration wait = Duration::zero());
  ReceiverStatus status() const;
  /// Ends the thread; datagrams that wait can still be taken.
  void stop();

 private:
  struct Impl;
  explicit UdpReceiver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::telemetry
