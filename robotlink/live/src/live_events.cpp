// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_events.h"

#include <cstdio>

namespace pitchboard::link {
namespace {

/// Events have their time in ticks; a live frame counts sixty a second.
std::uint64_t liveTick(double time) {
  return static_cast<std::uint64_t>(time * 60.0 + 0.5);
}

std::string clockWords(int seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%02d:%02d", seconds < 0 ? "-" : "", std::abs(seconds) / 60,
                std::abs(seconds) % 60);
  return text;
}

std::string teamWords(const RefereeTeamView& team) {
  return "team " + std::to_string(team.number) +
         (team.colour == "unknown" ? std::string() : " (" + team.colour + ")");
}

/// All that a spectator would call the state of the game.
std::string stateWords(const RefereeView& view) {
  std::string out = view.state;
  if (!view.setPlay.empty()) out += ", " + view.setPlay;
  if (!view.phase.empty()) out += ", " + view.phase;
  out += view.firstHalf ? ", first half" : ", second half";
  if (view.stopped) out += ", stopped";
  return out;
}

const RefereeTeamView* team(const RefereeView& view, int number) {
  for (const RefereeTeamView& side : view.teams) {
    if (side.number == number) return &side;
  }
  return nullptr;
}

std::string penaltyText(const Penalty& penalty) {
  return penalty.words +
         (penalty.secondsLeft > 0 ? ", " + std::to_string(penalty.secondsLeft) + " s" : "");
}

}  // namespace

void LiveEvents::compareReferee(const RefereeView& now, double time, LiveHappenings& out) {
  const auto say = [&](std::string text, bool warning = false) {
    out.lines.push_back({time, "referee", std::move(text), logLevel(warning)});
  };
  if (!m_referee) {
    say("heard: " + now.sender + ", version " + std::to_string(now.version) + ", " +
        teamWords(now.teams[0]) + " against " + teamWords(now.teams[1]));
    say(stateWords(now));
    return;
  }
  const RefereeView& before = *m_referee;
  if (now.sender != before.sender || now.version != before.version) {
    say("now " + now.sender + ", version " + std::to_string(now.version));
  }
  if (stateWords(now) != stateWords(before)) {
    say(stateWords(now) + " at " + clockWords(now.secondsLeft));
  }
  if (now.timedOut != before.timedOut) {
    if (now.timedOut)
      say("not heard for 10 s: the last state is shown", true);
    else
      say("is heard again");
  }
  if (now.conflict && !before.conflict) {
    say("a second referee program is heard; " + now.sender + " is shown", true);
  }
  for (std::size_t side = 0; side < now.teams.size(); ++side) {
    // Teams change sides at half-time: by number, not by place.
    const RefereeTeamView* was = team(before, now.teams[side].number);
    if (was == nullptr || was->score == now.teams[side].score) continue;
    const bool scored = now.teams[side].score > was->score;
    say((scored ? "goal for " : "score corrected for ") + teamWords(now.teams[side]) + ": " +
        std::to_string(now.teams[0].score) + " : " + std::to_string(now.teams[1].score));
    if (scored)
      out.events.push_back({sim::EventKind::Goal, liveTick(time), {}, static_cast<int>(side)});
  }
}

void LiveEvents::compareRobot(const RobotFrame& heard, double time, LiveHappenings& out) {
  const std::string name = heard.identity.name();
  const RobotHealth& robot = *heard.health;
  const auto say = [&](std::string text, bool warning = false) {
    out.lines.push_back({time, name, std::move(text), logLevel(warning)});
  };
  const auto [entry, isNew] = m_robots.try_emplace(heard.id());
  Known& known = entry->second;
  if (isNew) say("is heard from " + robot.sender.text());
  if (robot.timedOut != known.timedOut) {
    if (robot.timedOut) {
      say("is not heard any more (TIMEOUT)", true);
    } else if (!isNew) {
      say("is heard again");
    }
  }
  if (robot.conflict && !known.conflict) {
    say("number " + std::to_string(heard.identity.number) +
            " is also sent by another program; this one is " + robot.sender.text(),
        true);
  }
  if (robot.penalty && (!known.penalty || known.penalty->words != robot.penalty->words)) {
    say("penalised: " + penaltyText(*robot.penalty), true);
  } else if (!robot.penalty && known.penalty) {
    say("may play again");
  }
  known = {robot.timedOut, robot.conflict, robot.penalty};
}

LiveHappenings LiveEvents::compare(const MatchFrame& now) {
  LiveHappenings out;
  if (now.referee) {
    compareReferee(*now.referee, now.snapshot.time, out);
    m_referee = now.referee;
  }
  for (const RobotFrame& robot : now.robots) {
    if (robot.health) compareRobot(robot, now.snapshot.time, out);
  }
  std::erase_if(m_robots, [&now](const auto& known) { return now.robot(known.first) == nullptr; });
  return out;
}

std::vector<LogLine> LiveEvents::comparePorts(const telemetry::ReceiverStatus& network,
                                              double time) {
  std::vector<LogLine> lines;
  for (const telemetry::PortStatus& port : network.ports) {
    std::string& known = m_ports[port.port];
    if (port.problem == known) continue;
    if (port.bound) {
      lines.push_back({time, "network", "port " + std::to_string(port.port) + " is received now"});
    } else {
      lines.push_back({time, "network", port.problem + " It is tried again; the other ports work.",
                       LogLevel::Warning});
    }
    known = port.problem;
  }
  return lines;
}

}  // namespace pitchboard::link
