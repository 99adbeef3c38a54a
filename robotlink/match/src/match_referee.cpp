// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_referee.h"

#include <cmath>

#include <robotlink/match/referee_packet.h>
#include <telemetry/wire/gamecontroller_encoder.h>

namespace pitchboard::link {
namespace {

constexpr telemetry::Address loopbackBroadcast{0x7fffffff};  // 127.255.255.255: all that listen
constexpr double period = 0.5;                               // s, as all controllers
constexpr double quickPeriod = 0.2;                          // s, after play was stopped (2026)
constexpr int quickPackets = 5;

}  // namespace

Result<void> MatchReferee::sendTo(int port) {
  if (port < 1 || port > 65535) {
    return failure(ErrorCode::InvalidArgument, "the referee's port " + std::to_string(port) +
                                                   " does not lie in 1..65535");
  }
  auto sender = telemetry::UdpSender::to(loopbackBroadcast);
  if (!sender) return tl::unexpected(sender.error());
  m_sender = std::move(*sender);
  m_port = static_cast<std::uint16_t>(port);
  return {};
}

Result<void> MatchReferee::obey(int port, sim::Simulation& simulation) {
  if (port < 1 || port > 65535) {
    return failure(ErrorCode::InvalidArgument, "the GameController's port " +
                                                   std::to_string(port) +
                                                   " does not lie in 1..65535");
  }
  telemetry::ReceiverOptions options;
  options.ports = {static_cast<std::uint16_t>(port)};
  auto receiver = telemetry::UdpReceiver::start(options);
  if (!receiver) return tl::unexpected(receiver.error());
  m_receiver = std::move(*receiver);
  if (simulation.state().game) simulation.editState().settings.referee->automatic = false;
  return {};
}

bool MatchReferee::listen(sim::Simulation& simulation) {
  bool heard = false;
  if (!m_receiver->take(m_batch)) return heard;
  for (std::size_t i = 0; i < m_batch.size(); ++i) {
    const telemetry::DatagramView datagram = m_batch[i];
    const auto packet = telemetry::decodeReferee(datagram.payload);
    if (!packet) continue;
    const auto* state = std::get_if<telemetry::RefereeState>(&*packet);
    if (state == nullptr || !m_tracker.accept(*state, datagram.sender, datagram.time)) continue;
    const sim::PlayState before = simulation.state().game->state;
    adoptPacket(*state, simulation.editState());
    const sim::PlayState now = simulation.state().game->state;
    if (now != before && (now == sim::PlayState::Ready || now == sim::PlayState::Initial)) {
      (void)simulation.placeBall({});
    }
    m_packet = *state;
    heard = true;
  }
  return heard;
}

bool MatchReferee::tick(sim::Simulation& simulation) {
  const sim::WorldState& world = simulation.state();
  if (!world.game) return false;
  if (m_receiver) return listen(simulation);
  const double rate = world.settings.tickRate;
  const auto every = [rate](double seconds) {
    return static_cast<std::uint64_t>(std::max(1.0, std::round(seconds * rate)));
  };
  bool due = world.tick % every(period) == 0 || m_lastTick == 0 || world.tick < m_lastTick;
  const bool soccer = world.settings.referee->style == sim::RefereeStyle::HumanoidSoccer2026;
  if (soccer) {
    if (world.game->stopped && !m_stopped) {
      due = true;
      m_quick = quickPackets;
    } else if (m_quick > 0 && world.tick - m_lastTick >= every(quickPeriod)) {
      due = true;
      --m_quick;
    }
    m_stopped = world.game->stopped;
  }
  if (!due) return false;
  m_lastTick = std::max<std::uint64_t>(1, world.tick);
  m_packet = refereePacket(world, static_cast<int>((world.tick / every(period)) & 0xffU));
  if (m_sender) send();
  return true;
}

void MatchReferee::send() {
  if (const auto bytes = telemetry::encodeReferee(m_packet)) (void)m_sender->send(m_port, *bytes);
  if (m_packet.league == telemetry::League::Humanoid &&
      (m_packet.version == 8 || m_packet.version == 9)) {
    // As the controllers of 2014 to 2016.
    if (const auto bytes = telemetry::encodeReferee(telemetry::asVersion7(m_packet))) {
      (void)m_sender->send(m_port, *bytes);
    }
  }
}

}  // namespace pitchboard::link
