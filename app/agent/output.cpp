// SPDX-License-Identifier: GPL-3.0-or-later
#include "output.h"

#include <cerrno>
#include <utility>

#include <base/system_reason.h>
#include <base/try.h>

namespace pitchboard::agent {

Result<Output> Output::to(telemetry::Address address, int port) {
  auto sender = TRY(telemetry::UdpSender::to(address));
  return Output(std::move(sender), port, address.text() + ":" + std::to_string(port));
}

std::string Output::send(std::string_view datagram, std::chrono::microseconds now) {
  constexpr std::chrono::microseconds calm = std::chrono::seconds(2);
  if (m_sender.send(static_cast<std::uint16_t>(m_port), datagram)) {
    if (!m_failed || now - *m_failed < calm) return {};
    m_failed.reset();
    return "sending to " + m_name + " works again";
  }
  const int error = errno;
  const bool isNew = !m_failed.has_value();
  m_failed = now;
  if (!isNew) return {};
  return "cannot send to " + m_name + ": " + systemReason(error) + "; still trying";
}

}  // namespace pitchboard::agent
