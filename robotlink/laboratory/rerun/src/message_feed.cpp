// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_feed.h"

#include <array>

#include <base/try.h>
#include <robotlink/cognition/process_registry.h>

namespace pitchboard::link {
namespace {

using Stream = telemetry::SessionStream;

constexpr telemetry::Address loopbackBroadcast{0x7fffffff};  // 127.255.255.255: all that listen
constexpr std::array datagramStreams{Stream::Telemetry, Stream::RefereeRaw};

}  // namespace

bool hearsMessages(const std::string& process) {
  const ProcessInfo* known = findProcess(process);
  return known == nullptr || !known->receives.empty();
}

std::uint64_t MessageFeed::count(const telemetry::SessionReader& session) {
  std::uint64_t count = 0;
  for (const Stream stream : datagramStreams) count += session.count(stream);
  return count;
}

Result<MessageFeed> MessageFeed::start(const telemetry::SessionReader& session,
                                       const RecordedRobot& recorded) {
  const telemetry::RobotFacts& facts = factsOf(session.groups()[recorded.group].info);
  const std::string own = facts.sentFrom.empty() ? facts.sender : facts.sentFrom;
  return MessageFeed(TRY(telemetry::UdpSender::simulatedTo(loopbackBroadcast)),
                     own.substr(0, own.find(':')));
}

void MessageFeed::read(const telemetry::SessionReader& session, double from, double until) {
  session.messages(datagramStreams, {from, until}, [&](Stream, double time, std::string_view json) {
    auto datagram = telemetry::sessionDatagram(json);
    if (!datagram || time >= until) return true;
    if (m_own.empty() || datagram->sender.address.text() != m_own) {
      datagram->time = time;
      m_waiting.push_back(*std::move(datagram));
    }
    return true;
  });
}

void MessageFeed::sendTo(double time) {
  for (; !m_waiting.empty() && m_waiting.front().time <= time; m_waiting.pop_front()) {
    (void)m_sender.send(m_waiting.front().localPort, m_waiting.front().payload);
  }
}

}  // namespace pitchboard::link
