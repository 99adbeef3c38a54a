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

std::string teamText(const RefereeTeamView& team) {
  return "team " + std::to_string(team.number) +
         (team.colour == "unknown" ? std::string() : " (" + team.colour + ")");
}

const RefereeTeamView* team(const RefereeView& view, int number) {
  for (const RefereeTeamView& side : view.teams) {
    if (side.number == number) return &side;
  }
  return nullptr;
}

}  // namespace

void LiveEvents::compareReferee(const RefereeView& now, double time, std::vector<MatchEvent>& out) {
  // What a game begins with is nothing to tell.
  RefereeView before;
  const bool isFirst = !m_referee;
  if (m_referee) before = *m_referee;
  if (isFirst || now.sender != before.sender || now.version != before.version) {
    std::string who = now.sender;
    if (isFirst) who += ", " + teamText(now.teams[0]) + " against " + teamText(now.teams[1]);
    out.push_back(made(Kind::RefereeReceived, time, std::move(who), now.version));
  }
  if (now.state != before.state) {
    out.push_back(made(Kind::GameState, time, now.state, now.secondsLeft));
  }
  if (now.setPlay != before.setPlay) {
    out.push_back(made(Kind::SetPlay, time, now.setPlay));
    out.back().team = now.performingTeam.value_or(0);
  }
  if (now.phase != before.phase) out.push_back(made(Kind::GamePhase, time, now.phase));
  if (now.firstHalf != before.firstHalf) {
    out.push_back(made(Kind::Half, time, {}, now.firstHalf ? 1 : 2));
  }
  if (now.stopped != before.stopped) {
    out.push_back(made(now.stopped ? Kind::PlayStopped : Kind::PlayGoesOn, time));
  }
  if (now.timedOut != before.timedOut) {
    out.push_back(made(now.timedOut ? Kind::RefereeOffline : Kind::RefereeBack, time));
  }
  if (now.conflict && !before.conflict) {
    out.push_back(made(Kind::SecondReferee, time, now.sender));
  }
  if (isFirst) return;
  for (std::size_t i = 0; i < now.teams.size(); ++i) {
    // Teams change sides at half-time: by number, not by place.
    const RefereeTeamView& team = now.teams[i];
    const RefereeTeamView* was = link::team(before, team.number);
    if (was == nullptr || was->score == team.score) continue;
    MatchEvent event = made(team.score > was->score ? Kind::Goal : Kind::ScoreCorrected, time);
    event.side = i == 0 ? Side::Left : Side::Right;
    event.team = team.number;
    event.colour = team.colour;
    event.score = sim::Score{now.teams[0].score, now.teams[1].score};
    out.push_back(std::move(event));
  }
}

void LiveEvents::compareRobot(const RobotFrame& received, double time,
                              std::vector<MatchEvent>& out) {
  const telemetry::LinkHealth& link = *received.link;
  const auto add = [&](Kind kind, std::string detail = {}, std::optional<int> value = {}) {
    MatchEvent event = eventOf(kind, time, received.key, received.name);
    event.detail = std::move(detail);
    event.value = value;
    out.push_back(std::move(event));
  };
  const auto [entry, isNew] = m_robots.try_emplace(received.key);
  Known& known = entry->second;
  if (isNew) {
    add(Kind::RobotReceived, link.sender.text());
  } else if (link.sender.address != known.address) {
    add(Kind::AddressChanged, known.address.text() + " to " + link.sender.address.text());
  }
  if (link.timedOut != known.timedOut) {
    add(link.timedOut ? Kind::RobotOffline : Kind::RobotBack);
  }
  if (link.conflict && !known.conflict) add(Kind::SecondSender, link.sender.text());
  const auto& penalty = received.penalty;
  if (penalty && (!known.penalty || known.penalty->text != penalty->text)) {
    add(Kind::Penalised, penalty->text, penalty->secondsLeft);
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
  known.conflict = link.conflict;
  known.penalty = penalty;
  known.batteryLow = low;
}

std::vector<MatchEvent> LiveEvents::compare(const MatchFrame& now) {
  std::vector<MatchEvent> out;
  if (now.referee) {
    compareReferee(*now.referee, now.snapshot.time, out);
    m_referee = now.referee;
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
                                                 double time) {
  std::vector<MatchEvent> out;
  for (const telemetry::PortStatus& port : network.ports) {
    std::string& known = m_ports[port.port];
    if (port.problem == known) continue;
    out.push_back(
        made(port.bound ? Kind::PortBack : Kind::PortLost, time, port.problem, int{port.port}));
    known = port.problem;
  }
  return out;
}

}  // namespace pitchboard::link
