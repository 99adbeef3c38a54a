// SPDX-License-Identifier: GPL-3.0-or-later
// The only file of this library that may use the sender; tst_udp_receiver and
// tst_live_sends_nothing check that.
#include <telemetry/monitor/monitor_request.h>

#include <cerrno>

#include <base/system_reason.h>
#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::telemetry {

Result<void> sendMonitorRequest(Address referee, std::uint16_t port) {
  constexpr std::string_view request("RGTr\0", 5);
  const auto refused = [&](const std::string& why) {
    return failure(ErrorCode::SystemError, "The referee at " + referee.text() + ":" +
                                               std::to_string(port) +
                                               " cannot be asked for monitor mode: " + why + ".");
  };
  auto sender = UdpSender::to(referee);
  if (!sender) return refused(sender.error().message);
  if (!sender->send(port, request)) return refused(systemReason(errno));
  return {};
}

}  // namespace pitchboard::telemetry
