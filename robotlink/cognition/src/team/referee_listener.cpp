// SPDX-License-Identifier: GPL-3.0-or-later
#include "team/referee_listener.h"

#include <telemetry/wire/socket_address.h>

namespace pitchboard::link {

Result<std::unique_ptr<RefereeListener>> RefereeListener::start(const ProcessOptions& options) {
  const int player = options.shirt.value_or(options.robot.value);
  const auto refuse = [](const std::string& text) {
    return failure(ErrorCode::InvalidArgument, text, "referee");
  };
  if (!options.refereeTeam || *options.refereeTeam < 0 || *options.refereeTeam > 255) {
    return refuse("the number of a team is 0 to 255");
  }
  if (player < 1 || player > static_cast<int>(telemetry::RefereeTeam::maxPlayers)) {
    return refuse("a shirt has a number from 1 to 20, not " + std::to_string(player) +
                  "; give --shirt");
  }
  if (!telemetry::isPort(options.refereePort)) {
    return refuse("the port " + std::to_string(options.refereePort) + " does not lie in 1..65535");
  }
  telemetry::ReceiverOptions receiving;
  receiving.ports = {static_cast<std::uint16_t>(options.refereePort)};
  receiving.receiveBufferBytes = 1 << 18;
  receiving.maxDatagrams = 256;
  receiving.maxBytes = 1U << 18;
  auto receiver = telemetry::UdpReceiver::start(receiving);
  if (!receiver) return tl::unexpected<Error>(receiver.error());
  return std::unique_ptr<RefereeListener>(
      new RefereeListener(*options.refereeTeam, player, std::move(*receiver)));
}

std::optional<int> RefereeListener::newWord() {
  std::optional<int> word;
  if (!m_receiver->take(m_batch)) return word;
  for (std::size_t i = 0; i < m_batch.size(); ++i) {
    const telemetry::DatagramView datagram = m_batch[i];
    const auto packet = telemetry::decodeReferee(datagram.payload);
    if (!packet) continue;
    const auto* state = std::get_if<telemetry::RefereeState>(&*packet);
    if (state == nullptr || !m_tracker.accept(*state, datagram.sender, datagram.time)) continue;
    if (const auto meant = m_orders.take(*state, m_team, m_player)) word = meant;
  }
  return word;
}

}  // namespace pitchboard::link
