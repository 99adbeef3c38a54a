// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_referee.h"

#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/try.h>
#include <robotlink/match/referee_packet.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/sockets/socket_address.h>

namespace pitchboard::link {
namespace {

constexpr telemetry::Address loopbackBroadcast{0x7fffffff};  // 127.255.255.255: all that listen
constexpr double period = 0.5;                               // s, as all controllers
constexpr double quickPeriod = 0.2;                          // s, after play was stopped (2026)
constexpr int quickPackets = 5;

// The league's program wants replies at most twice a second and counts robots as late after 2 s.
constexpr std::chrono::milliseconds answerPeriod{550};
constexpr std::chrono::seconds answersFor{2};  // after its last packet

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
  const bool newForm = packet.league == League::HumanoidSoccer ||
                       (packet.league == League::StandardPlatform && packet.version >= since2022);
  return newForm ? 4 : 2;
}

/// "I am alive", and where: what a controller shows, and nothing that changes its game. Nothing
/// from a robot that does not play.
std::optional<telemetry::RobotReply> replyOf(const sim::RobotSnapshot& robot, const Point& ball,
                                             const Game& game,
                                             const telemetry::RefereeState& packet) {
  constexpr int alive = 2;
  constexpr double millimetres = 1000.0;
  const GamePlayer* player = game.player(robot.identity.team, robot.identity.number);
  const int team = game.teamOf(robot.identity.team);
  if (!player || player->penalty == PenaltyKind::SentOff) return {};
  const GameTeam& own = game.teams[static_cast<std::size_t>(team)];
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
  m_sender = TRY(telemetry::UdpSender::simulatedTo(loopbackBroadcast));
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
    if (state == nullptr) continue;
    using Verdict = telemetry::RefereeTracker::Verdict;
    const bool joins = !m_tracker.state();
    const Verdict verdict = m_tracker.accept(*state, datagram.sender, datagram.time);
    if (verdict == Verdict::Shown || verdict == Verdict::Repeated) m_heard = Clock::now();
    if (verdict != Verdict::Shown) continue;
    const Game before = *simulation.state().game;
    const Game heard = *m_tracker.game();
    adoptGame(heard, state->version == versionByColour, simulation.editState());
    const Game& game = *simulation.state().game;
    if (game.swapped != before.swapped) turnAllRobots(simulation);
    if (game.state != before.state &&
        (game.state == PlayState::Ready || game.state == PlayState::Initial)) {
      (void)simulation.placeBall({});
    }
    simulation.reportObeyed(before, joins);
    m_packet = *state;
    m_heardGame = heard;
    received = true;
  }
  return received;
}

/// In the rhythm of the replies, which is not that of the packets: while play is stopped there are
/// five of those a second.
void MatchReferee::answer(const sim::Simulation& simulation) {
  const Clock::time_point time = Clock::now();
  if (!m_answerPort || !m_heard || time - *m_heard > answersFor ||
      (m_answered && time - *m_answered < answerPeriod)) {
    return;
  }
  m_answered = time;
  const telemetry::Address controller = m_tracker.sender()->address;
  if (!m_answers || m_controller != controller) {
    auto sender = telemetry::UdpSender::to(controller);
    if (!sender) return;
    m_answers.emplace(std::move(*sender));
    m_controller = controller;
  }
  const std::uint16_t port =
      *m_answerPort > 0 ? static_cast<std::uint16_t>(*m_answerPort) : replyPort(m_packet.version);
  const Game& game = *simulation.state().game;
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
  if (m_receiver) {
    if (again) return false;
    const bool received = listen(simulation);
    answer(simulation);
    return received;
  }
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
  m_packet = refereePacket(world, m_nextNumber);
  m_heardGame = telemetry::gameOf(m_packet);
  if (m_sender && !again) send();
  return true;
}

void MatchReferee::send() {
  m_nextNumber = (m_nextNumber + 1) & 0xff;
  if (const auto bytes = telemetry::encodeReferee(m_packet)) (void)m_sender->send(m_port, *bytes);
  if (m_packet.league == League::Humanoid && (m_packet.version == 8 || m_packet.version == 9)) {
    // As the controllers of 2014 to 2016.
    if (const auto bytes = telemetry::encodeReferee(telemetry::asVersion7(m_packet))) {
      (void)m_sender->send(m_port, *bytes);
    }
  }
}

}  // namespace pitchboard::link
