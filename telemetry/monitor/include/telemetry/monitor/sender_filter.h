// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A list of allowed senders: addresses and networks. Any thread may read it once it is complete.

#include <string>
#include <string_view>
#include <vector>

#include <telemetry/sockets/datagram.h>

namespace pitchboard::telemetry {

/// An empty list allows everybody.
class SenderFilter {
 public:
  /// Reads "192.168.0.7" or "192.168.0.0/24" and adds it. Fails with
  /// InvalidArgument.
  Result<void> add(std::string_view text);
  bool allows(Address address) const;
  bool empty() const { return m_ranges.empty(); }
  /// Returns what add() reads back: "192.168.0.7", "192.168.0.0/24".
  std::vector<std::string> texts() const;

 private:
  struct Range {
    std::uint32_t address;
    std::uint32_t mask;
  };
  std::vector<Range> m_ranges;
};

}  // namespace pitchboard::telemetry
