// SPDX-License-Identifier: GPL-3.0-or-later
// The only file of this library that may send; tst_live_is_silent checks that.
#include <telemetry/wire/monitor_request.h>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>

#include <base/system_reason.h>

namespace pitchboard::telemetry {

Result<void> sendMonitorRequest(Address referee, std::uint16_t port) {
  constexpr char request[5] = {'R', 'G', 'T', 'r', '\0'};
  const auto refused = [&](int error) {
    return failure(ErrorCode::SystemError,
                   "The referee at " + referee.text() + ":" + std::to_string(port) +
                       " cannot be asked for monitor mode: " + systemReason(error) + ".");
  };
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return refused(errno);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(referee.value);
  const auto sent = sendto(descriptor, request, sizeof request, 0,
                           reinterpret_cast<const sockaddr*>(&to), sizeof to);
  const int error = errno;
  close(descriptor);
  if (sent != sizeof request) return refused(error);
  return {};
}

}  // namespace pitchboard::telemetry
