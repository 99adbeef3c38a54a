// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_referee.h"

#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/try.h>
#include <robotlink/match/referee_packet.h>
#include <telemetry/wire/gamecontroller_encoder.h>
#include <telemetry/wire/socket_address.h>

namespace pitchboard::link {
namespace {

constexpr telemetry::Address loopbackBroadcast{0x7fffffff};  // 127.255.255.255: all that listen
constexpr double period = 0.5;                               // s, as all controllers
constexpr double quickPeriod = 0.2;                          // s, after play was stopped (2026)
constexpr int quickPackets = 5;

/// Moves the robots of both teams to the other half, because the teams have changed sides.
void turnAllRobots(sim::Simulation& simulation) {
  const sim::Snapshot now = simulation.snapshot();
  for (const sim::RobotSnapshot& robot : now.robots) {
    if (simulation.state().game->teamOf(robot.identity.team) < 0) continue;
    const Pose& pose = robot.pose;
    (void)simulation.placeRobot(robot.identity.id, {{-pose.position.x, -pose.position.y},
                                                    wrapToPi(pose.yaw + std::numbers::pi)});
  }
}

/// The GameController's port for replies: another one in 2014 and 2015.
std::uint16_t replyPort(int packetVersion) {
  constexpr int lastOfOld = 8;
  constexpr std::uint16_t old = 3838, now = 3939;
  return packetVersion <= lastOfOld ? old : now;
}

/// Which form of replies goes with these packets.
int replyVersion(const telemetry::RefereeState& packet) {
  constexpr int since2022 = 15;
  if (packet.version <= 7) return 1;
  const bool newForm =
      packet.league == telemetry::League::HumanoidSoccer ||
      (packet.league == telemetry::League::StandardPlatform && packet.version >= since2022);
  return newForm ? 4 : 2;
}

/// "I am alive", and where: what a controller shows, and nothing that changes its game. Nothing
/// from a robot that does not play.
std::optional<telemetry::RobotReply> replyOf(const sim::RobotSnapshot& robot, const Point& ball,
                                             const sim::GameState& game,
                                             const telemetry::RefereeState& packet) {
  constexpr int alive = 2;
  constexpr double millimetres = 1000.0;
  const sim::GamePlayer* player = game.player(robot.identity.team, robot.identity.number);
  const int team = game.teamOf(robot.identity.team);
  if (!player || player->penalty == sim::PenaltyKind::SentOff) return {};
  const sim::GameTeam& own = game.teams[static_cast<std::size_t>(team)];
  telemetry::RobotReply reply;
  reply.version = replyVersion(packet);
  reply.team = own.number;
  reply.player = own.slotOf(robot.identity.number);
  reply.message = alive;
  reply.fallen = robot.fallen ? 1 : 0;
  // In the team's frame: +x towards the opponents' goal.
  const double attackSign = game.attacksRight(static_cast<std::size_t>(team)) ? 1.0 : -1.0;
  const Pose& pose = robot.pose;
  const double yaw = wrapToPi(pose.yaw + (attackSign > 0.0 ? 0.0 : std::numbers::pi));
  reply.pose = {static_cast<float>(attackSign * pose.position.x * millimetres),
                static_cast<float>(attackSign * pose.position.y * millimetres),
                static_cast<float>(yaw)};
  const double dx = ball.x - pose.position.x, dy = ball.y - pose.position.y;
  const bool sees = std::hypot(dx, dy) < robot.visionRange;
  reply.ballAge = sees ? 0.0F : -1.0F;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  reply.ball = {sees ? static_cast<float>((dx * c + dy * s) * millimetres) : 0.0F,
                sees ? static_cast<float>((dy * c - dx * s) * millimetres) : 0.0F};
  return reply;
}

}  // namespace

Result<void> MatchReferee::sendTo(int port) {
  if (!telemetry::isPort(port)) {
    return failure(ErrorCode::InvalidArgument,
                   "the referee's port " + std::to_string(port) + " does not lie in 1..65535");
  }
  m_sender = TRY(telemetry::UdpSender::to(loopbackBroadcast));
  m_port = static_cast<std::uint16_t>(port);
  return {};
}

Result<void> MatchReferee::obey(int port, sim::Simulation& simulation) {
  if (!telemetry::isPort(port)) {
    return failure(ErrorCode::InvalidArgument, "the GameController's port " + std::to_string(port) +
                                                   " does not lie in 1..65535");
  }
  telemetry::ReceiverOptions options;
  options.ports = {static_cast<std::uint16_t>(port)};
  m_receiver = TRY(telemetry::UdpReceiver::start(options));
  if (simulation.state().game) simulation.editState().settings.referee->automatic = false;
  return {};
}

bool MatchReferee::listen(sim::Simulation& simulation) {
  bool received = false;
  if (!m_receiver->take(m_batch)) return received;
  for (std::size_t i = 0; i < m_batch.size(); ++i) {
    const telemetry::DatagramView datagram = m_batch[i];
    const auto packet = telemetry::decodeReferee(datagram.payload);
    if (!packet) continue;
    const auto* state = std::get_if<telemetry::RefereeState>(&*packet);
    if (state == nullptr || !m_tracker.accept(*state, datagram.sender, datagram.time)) continue;
    const sim::PlayState before = simulation.state().game->state;
    const bool swapped = simulation.state().game->swapped;
    adoptPacket(*state, simulation.editState());
    if (simulation.state().game->swapped != swapped) turnAllRobots(simulation);
    const sim::PlayState now = simulation.state().game->state;
    if (now != before && (now == sim::PlayState::Ready || now == sim::PlayState::Initial)) {
      (void)simulation.placeBall({});
    }
    m_packet = *state;
    received = true;
    if (m_answerPort) answer(simulation, datagram.sender.address);
  }
  return received;
}

void MatchReferee::answer(const sim::Simulation& simulation, telemetry::Address controller) {
  if (!m_answers || m_controller != controller) {
    auto sender = telemetry::UdpSender::to(controller);
    if (!sender) return;
    m_answers.emplace(std::move(*sender));
    m_controller = controller;
  }
  const std::uint16_t port =
      *m_answerPort > 0 ? static_cast<std::uint16_t>(*m_answerPort) : replyPort(m_packet.version);
  const sim::GameState& game = *simulation.state().game;
  const sim::Snapshot now = simulation.snapshot();
  for (const sim::RobotSnapshot& robot : now.robots) {
    const auto reply = replyOf(robot, now.ball, game, m_packet);
    if (!reply) continue;
    if (const auto bytes = telemetry::encodeReply(*reply)) (void)m_answers->send(port, *bytes);
  }
}

bool MatchReferee::tick(sim::Simulation& simulation, bool again) {
  const sim::WorldState& world = simulation.state();
  if (!world.game) return false;
  if (m_receiver) return !again && listen(simulation);
  const double rate = world.settings.tickRate;
  const auto every = [rate](double seconds) {
    return static_cast<std::uint64_t>(std::max(1.0, std::round(seconds * rate)));
  };
  bool due =
      world.tick % every(period) == 0 || m_rhythm.lastTick == 0 || world.tick < m_rhythm.lastTick;
  if (!sim::conductOf(world.settings.referee->style).preparesSetPlays) {
    if (world.game->stopped && !m_rhythm.stopped) {
      due = true;
      m_rhythm.quick = quickPackets;
    } else if (m_rhythm.quick > 0 && world.tick - m_rhythm.lastTick >= every(quickPeriod)) {
      due = true;
      --m_rhythm.quick;
    }
    m_rhythm.stopped = world.game->stopped;
  }
  if (!due) return false;
  m_rhythm.lastTick = std::max<std::uint64_t>(1, world.tick);
  m_packet = refereePacket(world, static_cast<int>((world.tick / every(period)) & 0xffU));
  if (m_sender && !again) send();
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
