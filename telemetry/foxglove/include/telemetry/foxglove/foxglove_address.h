// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a program listens that speaks Foxglove's protocol. Plain value; any thread.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/result.h>

namespace pitchboard::telemetry {

struct FoxgloveAddress {
  static constexpr std::uint16_t usualPort = 8765;
  std::string host;  ///< name or IP address, without brackets
  std::uint16_t port = usualPort;
  std::string path = "/";
  bool operator==(const FoxgloveAddress&) const = default;
  /// Returns "ws://robot3:8765", which parseFoxgloveAddress() reads back.
  std::string text() const;
};

/// Reads "ws://robot3:8765/path", "ws://[fe80::1]", or "robot3". Fails with InvalidArgument.
Result<FoxgloveAddress> parseFoxgloveAddress(std::string_view text);

}  // namespace pitchboard::telemetry
