// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whom to listen to: everybody, or the addresses and networks that a list names. Any thread once it
// is made.

#include <string_view>
#include <vector>

#include <telemetry/wire/datagram.h>

namespace pitchboard::telemetry {

/// A list of addresses and networks; an empty one allows everybody.
class SenderFilter {
 public:
  /// Reads "192.168.0.7" or "192.168.0.0/24" and adds it. Error InvalidArgument.
  Result<void> add(std::string_view text);
  bool allows(Address address) const;
  bool empty() const { return m_ranges.empty(); }

 private:
  struct Range {
    std::uint32_t address;
    std::uint32_t mask;
  };
  std::vector<Range> m_ranges;
};

}  // namespace pitchboard::telemetry
