// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Datagrams as they arrive from the network, before they are decoded. Plain values; any thread.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

/// A time of day from a LiveClock. Setting the computer's clock does not shift it. Everything in
/// this library that needs the present takes it as an argument; only LiveClock reads clocks.
using WallTime = std::chrono::sys_time<std::chrono::nanoseconds>;
using Duration = std::chrono::nanoseconds;

constexpr double secondsOf(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// An IPv4 address in host byte order, so that 127.0.0.1 is 0x7f000001.
struct Address {
  std::uint32_t value = 0;
  auto operator<=>(const Address&) const = default;
  std::string text() const;
  /// Returns whether programs of this computer send from it, so that it does not tell robots apart.
  bool isLoopback() const { return value >> 24 == 127; }
};

/// Simulated robots and referees on this computer send from this address of the loopback network.
/// The receiver thus recognizes each of their datagrams, whichever program sent it, while the bytes
/// stay those of a real robot.
inline constexpr Address simulatedAddress{0x7f504201};  // 127.80.66.1
constexpr bool isSimulated(Address sender) {
  return sender == simulatedAddress;
}
/// Returns whether this is an address of the loopback network, 127.0.0.0/8.
constexpr bool isLoopback(Address address) {
  return address.value >> 24U == 127U;
}

/// Reads "192.168.0.7". Fails with InvalidArgument for anything else, host names included.
Result<Address> parseAddress(std::string_view text);

/// Where a datagram came from.
struct Sender {
  Address address;
  std::uint16_t port = 0;  ///< 0 if unknown
  auto operator<=>(const Sender&) const = default;
  std::string text() const;  ///< "192.168.0.7:41708", or only the address
};

/// A received datagram. The payload belongs to the batch that contains it.
struct DatagramView {
  WallTime time;  ///< when the kernel received it, or when we read it
  Sender sender;
  std::uint16_t localPort = 0;
  bool truncated = false;  ///< longer than the receive buffer; the rest is lost
  std::string_view payload;
};

/// Many datagrams in two blocks of memory. clear() keeps the memory, so a batch that is passed back
/// and forth between two threads stops allocating once it is large enough.
class DatagramBatch {
 public:
  void append(const DatagramView& datagram);
  void clear();
  std::size_t size() const { return m_heads.size(); }
  std::size_t bytes() const { return m_bytes.size(); }
  bool empty() const { return m_heads.empty(); }
  /// Valid until the batch is changed or destroyed.
  DatagramView operator[](std::size_t index) const;

 private:
  struct Head {
    WallTime time;
    Sender sender;
    std::uint16_t localPort;
    bool truncated;
    std::size_t offset;
    std::size_t length;
  };
  std::vector<Head> m_heads;
  std::string m_bytes;
};

}  // namespace pitchboard::telemetry
