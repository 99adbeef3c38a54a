// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_makers.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <base/try.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/referee_orders.h>
#include <telemetry/formats/text_protocol.h>
#include <telemetry/referee/referee_tracker.h>
#include <telemetry/sockets/socket_address.h>
#include <telemetry/sockets/udp_receiver.h>
#include <telemetry/sockets/udp_sender.h>

namespace pitchboard::link {
namespace {

constexpr int teamPorts = 4;
constexpr int distanceMessage = 2;  // the kind of team message, and the request in CONTROL_MESSAGES

constexpr double listenPeriod = 0.05;  // s: how soon a referee's word is on the blackboard

/// Hears the GameController for one robot.
class RefereeListener {
 public:
  using Datagrams = std::function<bool(telemetry::DatagramBatch&)>;

  RefereeListener(int team, int player, Datagrams datagrams)
      : m_team(team), m_player(player), m_datagrams(std::move(datagrams)) {}

  /// What the newest packet since the last call means to this robot, as a value of COM_REFEREE;
  /// nothing when there was none for it. Never blocks. If the referee goes offline, the last orders
  /// stay.
  std::optional<int> newOrder() {
    std::optional<int> order;
    if (!m_datagrams(m_batch)) return order;
    for (std::size_t i = 0; i < m_batch.size(); ++i) {
      const telemetry::DatagramView datagram = m_batch[i];
      const auto packet = telemetry::decodeReferee(datagram.payload);
      if (!packet) continue;
      const auto* state = std::get_if<telemetry::RefereeState>(&*packet);
      if (state == nullptr) continue;
      const auto verdict = m_tracker.accept(*state, datagram.sender, datagram.time);
      if (verdict != telemetry::RefereeTracker::Verdict::Shown) continue;
      if (const auto meant = m_orders.take(game(), m_team, m_player)) order = meant;
    }
    return order;
  }
  /// Only after an order.
  const Game& game() const { return *m_tracker.game(); }
  int team() const { return m_team; }

 private:
  int m_team, m_player;
  Datagrams m_datagrams;
  RefereeOrders m_orders;
  telemetry::RefereeTracker m_tracker;  // two versions at once, a second controller, late packets
  telemetry::DatagramBatch m_batch;
};

/// Returns the datagrams of a UDP port that is shared with others of this computer: each receives
/// every broadcast. While the port is in use it is tried again every few seconds.
Result<RefereeListener::Datagrams> datagramsOf(int port) {
  telemetry::ReceiverOptions receiving;
  receiving.ports = {static_cast<std::uint16_t>(port)};
  receiving.receiveBufferBytes = 1 << 18;
  receiving.maxDatagrams = 256;
  receiving.maxBytes = 1U << 18;
  const std::shared_ptr receiver = TRY(telemetry::UdpReceiver::start(receiving));
  return [receiver](telemetry::DatagramBatch& batch) { return receiver->take(batch); };
}

/// Listens for options.refereeTeam and options.shirt. Fails when the numbers are out of range or
/// the system gives no means to receive.
Result<std::unique_ptr<RefereeListener>> listenToReferee(const ProcessOptions& options) {
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
  auto datagrams =
      options.refereeDatagrams ? options.refereeDatagrams : TRY(datagramsOf(options.refereePort));
  return std::make_unique<RefereeListener>(*options.refereeTeam, player, std::move(datagrams));
}

// Obeys the referee in every cycle. Once a second (or as often as asked), as published: says which
// robot this blackboard belongs to, sends a team message and the telemetry datagram, and clears the
// five *_WORKING flags, which their owners set again.
//
// Team message "2 n DIST", DIST in cm: robot n's distance to the ball. It is VISION_BALL_DIST while
// the ball is in view. A decision process that wants to tell another value writes it to
// DECISION_RBTnn_DIST_BALL and 2 to CONTROL_MESSAGES (how published processes ask); it is then sent
// whether or not the ball is in view, and the request is cleared.
class Communication final : public CognitiveProcess {
 public:
  Communication(const ProcessOptions& options, std::optional<telemetry::UdpSender> sender,
                std::unique_ptr<RefereeListener> referee)
      : m_options(options), m_sender(std::move(sender)), m_referee(std::move(referee)) {
    const VariableCatalog& catalog = VariableCatalog::published();
    m_request = catalog.intVar("CONTROL_MESSAGES");
    m_ownDistance =
        catalog.floatVar("DECISION_RBT0" + std::to_string(options.robot.value) + "_DIST_BALL");
  }

  void step(Blackboard& board, const Clock& clock) override {
    if (m_referee) {
      if (const auto order = m_referee->newOrder()) {
        m_refereeVariables.write(board, *order, m_referee->game(), m_referee->team(),
                                 m_options.announceSetPlay);
      }
    }
    constexpr double rounding = 1e-6;
    // A match that was put back to an earlier moment.
    if (m_nextTelemetry > clock.seconds + m_options.telemetryPeriod)
      m_nextTelemetry = clock.seconds;
    if (clock.seconds < m_nextTelemetry - rounding) return;
    // By absolute time, so that the rate does not drift; what was missed is left out.
    m_nextTelemetry += m_options.telemetryPeriod;
    if (m_nextTelemetry <= clock.seconds)
      m_nextTelemetry = clock.seconds + m_options.telemetryPeriod;
    board.write(m_variables.robotNumber, m_options.robot.value);
    writeTeam(board);
    sendTelemetry(board);
  }

  double period() const override { return listenPeriod; }

 private:
  void writeTeam(Blackboard& board) {
    const bool asked = m_request && board.read(*m_request) == distanceMessage;
    if (!asked && board.read(m_variables.visionLost) != 0) return;
    const float distance =
        board.read(asked && m_ownDistance ? *m_ownDistance : m_variables.visionBallDist);
    const std::string message = std::to_string(distanceMessage) + " " +
                                std::to_string(m_options.robot.value) + " " +
                                telemetry::pythonFloat(distance);
    for (int n = 1; n <= teamPorts; ++n) send(m_options.teamPortBase + n, message);
    if (asked) board.replace(*m_request, distanceMessage, 0);
  }

  void sendTelemetry(Blackboard& board) {
    const RobotVariables& v = m_variables;
    telemetry::TextMessage m;
    m.robot = m_options.robot.value;
    m.x = board.read(v.localizationX);
    m.y = board.read(v.localizationY);
    m.theta = board.read(v.localizationTheta);
    m.belief = board.read(v.localizationBelief);
    m.ballDist = board.read(v.visionBallDist);
    m.ballAngle = board.read(v.visionPanDeg);  // VISION_BALL_ANGLE is never written
    const auto take = [&board](IntVar flag) {
      const int value = board.read(flag);
      board.write(flag, 0);
      return value;
    };
    m.control = take(v.controlWorking);
    m.vision = take(v.visionWorking);
    m.localization = take(v.localizationWorking);
    m.decision = take(v.decisionWorking);
    m.imu = take(v.imuWorking);
    m.actionA = board.read(v.decisionActionA);
    m.imuEulerZ = board.read(v.imuEulerZ);
    m.voltage = board.read(v.voltage);
    send(m_options.telemetryPortBase + m_options.robot.value, telemetry::encode(m));
  }

  void send(int port, const std::string& message) {
    if (m_sender) m_sender->send(static_cast<std::uint16_t>(port), message);
  }

  ProcessOptions m_options;
  std::optional<telemetry::UdpSender> m_sender;
  std::unique_ptr<RefereeListener> m_referee;  // when there is a team to listen for
  double m_nextTelemetry = 0.0;
  RobotVariables m_variables;
  RefereeVariables m_refereeVariables{VariableCatalog::extended()};
  std::optional<IntVar> m_request;
  std::optional<FloatVar> m_ownDistance;  // the published map has one for robots 1 to 4
};

Result<void> checkPorts(std::string_view what, int first, int last) {
  if (first >= 1 && last <= telemetry::highestPort) return {};
  return failure(ErrorCode::InvalidArgument,
                 "the " + std::string(what) + " would be " + std::to_string(first) +
                     (last != first ? ".." + std::to_string(last) : "") +
                     "; choose a base so that it lies in 1..65535");
}

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makeCommunication(const ProcessOptions& options) {
  const int telemetryPort = options.telemetryPortBase + options.robot.value;
  for (const Result<void>& ports :
       {checkPorts("telemetry port", telemetryPort, telemetryPort),
        checkPorts("ports of the team messages", options.teamPortBase + 1,
                   options.teamPortBase + teamPorts)}) {
    if (!ports) return tl::unexpected<Error>(ports.error());
  }
  const auto address = TRY(telemetry::parseAddress(options.udpAddress));
  std::optional<telemetry::UdpSender> sender;
  if (options.sends) sender = TRY(telemetry::UdpSender::simulatedTo(address));
  if (!(options.telemetryPeriod >= listenPeriod && options.telemetryPeriod <= 60.0)) {
    return failure(ErrorCode::InvalidArgument, "the telemetry period must be 0.05 to 60 seconds");
  }
  std::unique_ptr<RefereeListener> referee;
  if (options.refereeTeam) {
    referee = TRY(listenToReferee(options));
  }
  return std::make_unique<Communication>(options, std::move(sender), std::move(referee));
}

}  // namespace pitchboard::link
