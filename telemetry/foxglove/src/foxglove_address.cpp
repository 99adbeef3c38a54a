// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/foxglove/foxglove_address.h>

#include <algorithm>
#include <charconv>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t longestHost = 253, longestPath = 1000;

bool isPlain(unsigned char letter) {
  return letter > ' ' && letter < 0x7f;
}

}  // namespace

std::string FoxgloveAddress::text() const {
  const bool isV6 = host.find(':') != host.npos;
  return "ws://" + (isV6 ? "[" + host + "]" : host) + ":" + std::to_string(port) +
         (path == "/" ? std::string() : path);
}

Result<FoxgloveAddress> parseFoxgloveAddress(std::string_view text) {
  const auto wrong = [&text](const std::string& why) {
    return failure(ErrorCode::InvalidArgument, "\"" + std::string(text.substr(0, 100)) +
                                                   "\" is not the address of a Foxglove bridge: " +
                                                   why + " An example is ws://robot3:8765.");
  };
  if (!std::ranges::all_of(text, isPlain)) return wrong("it has spaces or other odd characters.");
  std::string_view rest = text;
  if (rest.starts_with("wss://")) return wrong("encrypted connections (wss) are not supported.");
  if (rest.starts_with("ws://")) rest.remove_prefix(5);
  if (rest.find("://") != rest.npos) return wrong("it must begin with ws://.");
  FoxgloveAddress address;
  if (const auto slash = rest.find('/'); slash != rest.npos) {
    address.path = rest.substr(slash);
    rest = rest.substr(0, slash);
  }
  std::string_view port;
  if (rest.starts_with('[')) {
    const auto end = rest.find(']');
    if (end == rest.npos) return wrong("a bracket is open.");
    address.host = rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (!rest.empty() && rest.front() != ':') return wrong("a colon must follow the bracket.");
    if (!rest.empty()) port = rest.substr(1);
    if (!rest.empty() && port.empty()) return wrong("the port is missing.");
  } else {
    const auto colon = rest.find(':');
    address.host = rest.substr(0, colon);
    if (colon != rest.npos) {
      port = rest.substr(colon + 1);
      if (port.empty()) return wrong("the port is missing.");
    }
  }
  if (address.host.empty()) return wrong("the host is missing.");
  if (address.host.size() > longestHost || address.path.size() > longestPath) {
    return wrong("it is too long.");
  }
  if (address.host.find_first_of("@?#\\\"<>") != std::string::npos) {
    return wrong("the host has odd characters.");
  }
  if (!port.empty()) {
    int number = 0;
    const auto read = std::from_chars(port.data(), port.data() + port.size(), number);
    if (read.ec != std::errc() || read.ptr != port.data() + port.size() || number < 1 ||
        number > 65535) {
      return wrong("the port must be from 1 to 65535.");
    }
    address.port = static_cast<std::uint16_t>(number);
  }
  return address;
}

}  // namespace pitchboard::telemetry
