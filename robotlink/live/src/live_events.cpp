// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/live_events.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace pitchboard::link {
namespace {

using Kind = MatchEventKind;

MatchEvent made(Kind kind, double time, std::string detail = {}, std::optional<int> value = {}) {
  MatchEvent event;
  event.kind = kind;
  event.time = time;
  event.detail = std::move(detail);
  event.value = value;
  return event;
}

std::string teamText(const GameTeam& team) {
  return "team " + std::to_string(team.number) +
         (team.colour == TeamColor::Unknown ? std::string()
                                            : " (" + std::string(info(team.colour).name) + ")");
}

}  // namespace

void LiveEvents::compareReferee(const MatchFrame& frame, std::vector<MatchEvent>& out) {
  const Game& now = *frame.game;
  const RefereeReception& reception = frame.reception;
  const double time = frame.snapshot.time;
  // What a game begins with is nothing to tell.
  const bool isFirst = !m_game;
  const Game before = m_game.value_or(Game{});
  if (isFirst || reception.sender != m_reception.sender ||
      reception.version != m_reception.version) {
    std::string who = (reception.simulated ? "simulated, " : "") + reception.sender;
    if (isFirst) {
      who += ", " + teamText(now.teamAt(false)) + " against " + teamText(now.teamAt(true));
    }
    out.push_back(made(Kind::RefereeReceived, time, std::move(who), reception.version));
  }
  if (isFirst || now.state != before.state) {
    out.push_back(made(Kind::GameState, time, std::string(labelOf(now.state)), now.secondsLeft()));
    out.back().state = now.state;
  }
  if (now.setPlay() != before.setPlay()) {
    out.push_back(made(Kind::SetPlay, time, std::string(labelOf(now.setPlay()))));
    const int taker = now.setPlayTeam();
    if (taker >= 0) out.back().team = now.teams[static_cast<std::size_t>(taker)].number;
  }
  if (now.phase != before.phase) {
    const bool normal = now.phase == GamePhase::Normal;
    out.push_back(
        made(Kind::GamePhase, time, normal ? std::string() : std::string(labelOf(now.phase))));
  }
  if (now.half != before.half) out.push_back(made(Kind::Half, time, {}, now.half));
  if (now.stopped != before.stopped) {
    out.push_back(made(now.stopped ? Kind::PlayStopped : Kind::PlayGoesOn, time));
  }
  if (reception.timedOut != m_reception.timedOut) {
    out.push_back(made(reception.timedOut ? Kind::RefereeOffline : Kind::RefereeBack, time));
  }
  if (reception.conflict && !m_reception.conflict) {
    out.push_back(made(Kind::SecondReferee, time, reception.sender));
  }
  if (isFirst) return;
  for (const bool right : {false, true}) {
    // Teams change sides at half-time: by number, not by place.
    const GameTeam& team = now.teamAt(right);
    const int was = before.teamNumbered(team.number);
    if (was == Game::noTeam) continue;
    const int scored = team.score - before.teams[static_cast<std::size_t>(was)].score;
    if (scored == 0) continue;
    MatchEvent event = made(scored > 0 ? Kind::Goal : Kind::ScoreCorrected, time);
    event.side = right ? Side::Right : Side::Left;
    event.team = team.number;
    event.colour = team.colour;
    event.teamName = teamName(team.number, frame.teams);
    event.score = sim::Score{now.teamAt(false).score, now.teamAt(true).score};
    out.push_back(std::move(event));
  }
}

void LiveEvents::compareRobot(const RobotFrame& received, double time,
                              std::vector<MatchEvent>& out) {
  const telemetry::LinkHealth& link = *received.link;
  const auto add = [&](Kind kind, std::string detail = {}, std::optional<int> value = {}) {
    MatchEvent event = eventOf(kind, time, received.uid, received.name);
    event.detail = std::move(detail);
    event.value = value;
    out.push_back(std::move(event));
  };
  const auto [entry, isNew] = m_robots.try_emplace(received.uid);
  Known& known = entry->second;
  if (isNew) {
    add(Kind::RobotReceived, link.sender.text());
  } else if (link.sender.address != known.address) {
    add(Kind::AddressChanged, known.address.text() + " to " + link.sender.address.text());
  }
  const double lastMessage = time - telemetry::secondsOf(link.age);
  if (link.timedOut && !known.timedOut) add(Kind::RobotOffline);
  if (!link.timedOut && known.timedOut) {
    add(Kind::RobotBack, {}, static_cast<int>(std::lround(lastMessage - known.lastMessage)));
  }
  if (link.conflict && !known.conflict) add(Kind::SecondSender, link.sender.text());
  const auto penalty = received.penalty && !received.penalty->isSubstitute()
                           ? received.penalty
                           : std::optional<Penalty>();
  if (penalty && (!known.penalty || known.penalty->kind != penalty->kind)) {
    add(Kind::Penalised, std::string(labelOf(penalty->kind)), penalty->secondsLeft);
  } else if (!penalty && known.penalty) {
    add(Kind::PenaltyOver);
  }
  // A voltage trembles: it is low until it is well above.
  constexpr double well = 0.1;
  bool low = known.batteryLow;
  if (received.battery && !link.timedOut) {
    low = received.battery->low || (low && received.battery->fraction < known.lowFraction + well);
    if (low && !known.batteryLow) {
      if (received.battery->volts > 0.0) {
        add(Kind::BatteryLow, {}, static_cast<int>(std::lround(received.battery->volts * 10.0)));
      } else {
        add(Kind::BatteryLow,
            std::to_string(std::lround(received.battery->fraction * 100.0)) + " %");
      }
      known.lowFraction = received.battery->fraction;
    }
  }
  if (!link.timedOut) {
    if (const auto kind = known.ball.look(received.ball.has_value(), time)) add(*kind);
  }
  known.address = link.sender.address;
  known.timedOut = link.timedOut;
  known.lastMessage = lastMessage;
  known.conflict = link.conflict;
  known.penalty = penalty;
  known.batteryLow = low;
}

std::vector<MatchEvent> LiveEvents::compare(const MatchFrame& now) {
  std::vector<MatchEvent> out;
  if (now.game) {
    compareReferee(now, out);
    m_game = now.game;
    m_reception = now.reception;
  }
  for (const RobotFrame& robot : now.robots) {
    if (robot.link) compareRobot(robot, now.snapshot.time, out);
  }
  std::erase_if(m_robots, [&now](const auto& known) { return now.robot(known.first) == nullptr; });
  return out;
}

std::vector<MatchEvent> LiveEvents::compareClock(telemetry::Duration setBy, double time) {
  using std::chrono::round;
  using std::chrono::seconds;
  const auto by = round<seconds>(setBy - m_setBy).count();
  if (by == 0) return {};
  m_setBy = setBy;
  constexpr std::int64_t most = 2'000'000'000;
  return {made(Kind::ClockSet, time, {}, static_cast<int>(std::clamp(by, -most, most)))};
}

std::vector<MatchEvent> LiveEvents::comparePorts(const telemetry::ReceiverStatus& network,
                                                 const std::string& shared, double time) {
  std::vector<MatchEvent> out;
  for (const telemetry::PortStatus& port : network.ports) {
    std::string& known = m_ports[port.port];
    if (port.problem == known) continue;
    out.push_back(
        made(port.bound ? Kind::PortBack : Kind::PortLost, time, port.problem, int{port.port}));
    known = port.problem;
  }
  if (shared != m_shared) {
    out.push_back(made(Kind::PortsShared, time, shared));
    m_shared = shared;
  }
  return out;
}

}  // namespace pitchboard::link
