// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/match_event.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <base/duration_text.h>
#include <robotlink/frame/match_frame.h>
#include <simcore/world/action_codes.h>

namespace pitchboard::link {
namespace {

using Kind = MatchEventKind;
using Shape = EventShape;

constexpr std::array<MatchEventInfo, matchEventKindCount> infos{{
    {Kind::Goal, "goal", "goal", Shape::Goal, 9, true, false, "simulation"},
    {Kind::ScoreCorrected, "score-corrected", "score corrected", Shape::None, 0, false, false,
     "referee"},
    {Kind::BallOut, "ball-out", "the ball is out", Shape::BallOut, 3, false, false, "simulation"},
    {Kind::Kick, "kick", "kicks the ball", Shape::Kick, 1, false, false, ""},
    {Kind::Fall, "fall", "falls", Shape::Fall, 4, false, true, ""},
    {Kind::GotUp, "got-up", "is up again", Shape::None, 0, false, false, ""},
    {Kind::UnknownAction, "unknown-action", "chose an unknown action, which counts as stop",
     Shape::None, 0, false, true, ""},
    {Kind::BallSeen, "ball-seen", "sees the ball", Shape::None, 0, false, false, ""},
    {Kind::BallLost, "ball-lost", "lost the ball: not seen for 2 s", Shape::BallLost, 0, false,
     false, ""},
    {Kind::GameState, "referee", "", Shape::GameState, 6, true, false, "referee"},
    {Kind::MatchOver, "match-over", "the match is over", Shape::GameState, 6, true, false,
     "simulation"},
    {Kind::Half, "half", "half", Shape::None, 0, false, false, "referee"},
    {Kind::SetPlay, "set-play", "normal play", Shape::None, 0, false, false, "referee"},
    {Kind::GamePhase, "game-phase", "normal time", Shape::None, 0, false, false, "referee"},
    {Kind::PlayStopped, "play-stopped", "play stopped", Shape::None, 0, false, false, "referee"},
    {Kind::PlayGoesOn, "play-goes-on", "play resumed", Shape::None, 0, false, false, "referee"},
    {Kind::RefereeReceived, "referee-heard", "receiving", Shape::None, 0, false, false, "referee"},
    {Kind::RefereeOffline, "referee-silent", "offline: the last state is kept", Shape::None, 0,
     false, true, "referee"},
    {Kind::RefereeBack, "referee-back", "is back", Shape::None, 0, false, false, "referee"},
    {Kind::SecondReferee, "second-referee", "a second referee program is sending", Shape::None, 0,
     false, true, "referee"},
    {Kind::RobotReceived, "robot-heard", "is online", Shape::None, 0, false, false, ""},
    {Kind::RobotOffline, "timeout", "went offline", Shape::Offline, 7, false, true, ""},
    {Kind::RobotBack, "recovery", "is online again", Shape::Back, 2, false, false, ""},
    {Kind::SecondSender, "second-sender", "is also sent by another program", Shape::None, 0, false,
     true, ""},
    {Kind::BatteryLow, "battery-low", "has a low battery", Shape::Warning, 4, false, true, ""},
    {Kind::AddressChanged, "address-changed", "changed its address", Shape::None, 0, false, false,
     ""},
    {Kind::ClockSet, "clock-set", "the computer's clock was set", Shape::None, 0, false, true,
     "studio"},
    {Kind::Penalised, "penalty", "penalised", Shape::Warning, 5, false, true, ""},
    {Kind::PenaltyOver, "penalty-over", "may play again", Shape::None, 0, false, false, ""},
    {Kind::ProcessStarted, "process-started", "started", Shape::None, 0, false, false, ""},
    {Kind::ProcessRestarted, "process-restarted", "started again", Shape::Started, 2, false, false,
     ""},
    {Kind::ProcessEnded, "process-ended", "ended", Shape::None, 0, false, false, ""},
    {Kind::ProcessDied, "process-died", "died", Shape::Died, 8, false, true, ""},
    {Kind::ProcessNotResponding, "process-silent", "stopped responding", Shape::Offline, 7, false,
     true, ""},
    {Kind::ProcessGivenUp, "process-given-up", "is no longer restarted", Shape::Died, 8, false,
     true, ""},
    {Kind::ProcessRealTime, "process-real-time", "uses real time", Shape::None, 0, false, true, ""},
    {Kind::ProcessNotAttached, "process-not-attached", "has not attached to its blackboard",
     Shape::Warning, 5, false, true, ""},
    {Kind::CycleLate, "cycle-late", "did not finish its cycle in time", Shape::Offline, 7, false,
     true, ""},
    {Kind::PortLost, "port-lost", "cannot receive on a port", Shape::None, 0, false, true,
     "network"},
    {Kind::PortBack, "port-back", "is open now", Shape::None, 0, false, false, "network"},
    {Kind::PortsShared, "ports-shared", "no other program receives on the robots' ports now",
     Shape::None, 0, false, true, "network"},
    {Kind::SettingChanged, "setting-changed", "settings changed", Shape::GameState, 2, false, false,
     "studio"},
    {Kind::RerunDiffers, "rerun-differs", "differs from the recording", Shape::Warning, 4, false,
     false, ""},
    {Kind::LetGo, "let-go", "robots stopped following the recording", Shape::Started, 6, false,
     false, "studio"},
    {Kind::Undone, "undone", "decision undone", Shape::None, 0, false, false, "referee"},
    {Kind::Bookmark, "bookmark", "bookmark", Shape::Bookmark, 10, true, false, "studio"},
    {Kind::Other, "warning", "warning", Shape::Warning, 5, false, true, "session"},
    {Kind::RuleBroken, "rule", "broke a rule", Shape::Warning, 3, false, true, "rules"},
    {Kind::Note, "note", "note", Shape::Bookmark, 10, true, false, "studio"},
}};

constexpr bool inOrder() {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (infos[i].kind != static_cast<Kind>(i)) return false;
  }
  return true;
}
static_assert(inOrder());

std::string clockText(int seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%02d:%02d", seconds < 0 ? "-" : "", std::abs(seconds) / 60,
                std::abs(seconds) % 60);
  return text;
}

/// "RoboFEI", "BLUE", "TEAM 12", "the left side".
std::string teamText(const MatchEvent& event) {
  if (!event.teamName.empty()) return event.teamName;
  if (event.colour && event.colour != TeamColor::Unknown) {
    std::string out(info(*event.colour).name);
    for (char& c : out) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return out;
  }
  if (event.team != 0) return "TEAM " + std::to_string(event.team);
  return event.side ? "the " + std::string(sideName(*event.side)) + " side" : std::string();
}

/// Returns the predicate of the kind, followed by the details.
std::string predicateWithDetail(const MatchEvent& event, std::string_view join = ": ") {
  std::string out(info(event.kind).predicate);
  if (event.detail.empty()) return out;
  if (!out.empty()) out += join;
  return out + event.detail;
}

/// What is said, without the robot or process of which it is said.
std::string predicateOf(const MatchEvent& event) {
  switch (event.kind) {
    case Kind::Goal:
    case Kind::ScoreCorrected: {
      std::string out(info(event.kind).predicate);
      if (const std::string team = teamText(event); !team.empty()) out += " for " + team;
      if (event.score) {
        out +=
            ", " + std::to_string(event.score->left) + " : " + std::to_string(event.score->right);
      }
      return out;
    }
    case Kind::Kick:
      return event.value
                 ? std::string(info(event.kind).predicate) + ": " + actionLabel(*event.value)
                 : predicateWithDetail(event);
    case Kind::UnknownAction:
      return event.value ? "chose the unknown action code " + std::to_string(*event.value) +
                               ", which counts as stop"
                         : predicateWithDetail(event);
    case Kind::GameState:
      return event.detail + (event.value ? " at " + clockText(*event.value) : std::string());
    case Kind::MatchOver:
      return predicateWithDetail(event, " (") + (event.detail.empty() ? "" : ")");
    case Kind::Half:
      return event.value == 2 ? "second half" : "first half";
    case Kind::SetPlay:
      if (!event.detail.empty() && event.team != 0) return event.detail + " for " + teamText(event);
      [[fallthrough]];
    case Kind::GamePhase:
      return event.detail.empty() ? std::string(info(event.kind).predicate) : event.detail;
    case Kind::RefereeReceived:
      return predicateWithDetail(event) +
             (event.value ? ", version " + std::to_string(*event.value) : std::string());
    case Kind::SecondReferee:
      return predicateWithDetail(event, "; showing ");
    case Kind::RobotReceived:
      return predicateWithDetail(event, " from ");
    case Kind::RobotBack:
      return std::string(info(event.kind).predicate) +
             (event.value.value_or(0) > 0 ? " after " + durationText(*event.value) : std::string());
    case Kind::SecondSender:
      return predicateWithDetail(event, "; this one is ");
    case Kind::BatteryLow:
      return predicateWithDetail(event, ": ") +
             (event.value ? ": " + std::to_string(*event.value / 10) + '.' +
                                std::to_string(std::abs(*event.value) % 10) + " V"
                          : std::string());
    case Kind::ClockSet:
      return predicateWithDetail(event) + " by " + (event.value.value_or(0) > 0 ? "+" : "") +
             std::to_string(event.value.value_or(0)) + " s; timestamps in Live are not affected";
    case Kind::Penalised:
      if (event.detail == labelOf(PenaltyKind::Substitute)) return "taken off as a substitute";
      return predicateWithDetail(event) +
             (event.value.value_or(0) > 0 ? ", " + durationText(*event.value) : std::string());
    case Kind::ProcessStarted:
    case Kind::ProcessRestarted:
      return std::string(info(event.kind).predicate) +
             (event.value ? " (process " + std::to_string(*event.value) + ')' : std::string());
    case Kind::ProcessEnded:
      return event.detail.empty() ? "stopped" : predicateWithDetail(event);
    case Kind::ProcessNotAttached:
      return predicateWithDetail(event, " ");
    case Kind::SettingChanged:
      return event.detail.empty() ? std::string(info(event.kind).predicate)
                                  : event.detail + " changed";
    case Kind::PortsShared:
      return event.detail.empty() ? std::string(info(event.kind).predicate) : event.detail;
    case Kind::PortLost:
      return event.detail + " Trying again; the other ports work.";
    case Kind::PortBack:
      return "port " + std::to_string(event.value.value_or(0)) + ' ' +
             std::string(info(event.kind).predicate);
    default:
      return predicateWithDetail(event);
  }
}

/// Returns "B1" or "B1 decision"; empty for events that concern no robot.
std::string subjectOf(const MatchEvent& event) {
  std::string out = event.name;
  if (!event.process.empty()) out += (out.empty() ? "" : " ") + event.process;
  return out;
}

}  // namespace

const MatchEventInfo& info(MatchEventKind kind) {
  return infos[static_cast<std::size_t>(kind)];
}

std::optional<MatchEventKind> matchEventKind(std::string_view name) {
  const auto found =
      std::find_if(infos.begin(), infos.end(), [name](const auto& i) { return i.name == name; });
  return found == infos.end() ? std::nullopt : std::optional(found->kind);
}

std::string_view sideName(Side side) {
  return side == Side::Left ? "left" : "right";
}

std::optional<Side> sideNamed(std::string_view name) {
  if (name == sideName(Side::Left)) return Side::Left;
  if (name == sideName(Side::Right)) return Side::Right;
  return {};
}

MatchEvent eventOf(MatchEventKind kind, double time, RobotUid robot, std::string name) {
  MatchEvent event;
  event.kind = kind;
  event.time = time;
  event.robot = robot;
  event.name = std::move(name);
  return event;
}

TeamColor teamOn(Side side, std::span<const sim::RobotIdentity> robots) {
  for (const sim::RobotIdentity& robot : robots) {
    if (robot.imuStartsAt180 == (side == Side::Right)) return robot.team;
  }
  return side == Side::Left ? TeamColor::Blue : TeamColor::Red;
}

namespace {

/// " for red": the side that has the ball.
std::string sideWithBall(const sim::WorldState& state) {
  if (!state.game || state.game->restart.team < 0) return {};
  const auto team = static_cast<std::size_t>(state.game->restart.team);
  return " for " + std::string(info(state.game->teams[team].colour).name);
}

/// The referee's number of the team, its colour, and its name if the scenario gives one.
void setTeam(TeamColor colour, const sim::WorldState& state, MatchEvent& out) {
  out.colour = colour;
  if (!state.game) return;
  const int team = state.game->teamOf(colour);
  if (team >= 0) out.team = state.game->teams[static_cast<std::size_t>(team)].number;
  const auto& named = state.settings.teams;
  const auto found = std::ranges::find(named, colour, &sim::TeamSettings::colour);
  if (found != named.end()) out.teamName = found->name;
}

/// What an event of the simulation is here, in the order of sim::EventKind.
constexpr std::array kindOfSimulated{Kind::Goal,           Kind::BallOut,     Kind::Kick,
                                     Kind::Fall,           Kind::GotUp,       Kind::UnknownAction,
                                     Kind::ScoreCorrected, Kind::GameState,   Kind::Half,
                                     Kind::GamePhase,      Kind::SetPlay,     Kind::SetPlay,
                                     Kind::SetPlay,        Kind::PlayStopped, Kind::PlayGoesOn,
                                     Kind::Penalised,      Kind::PenaltyOver, Kind::GamePhase,
                                     Kind::SettingChanged, Kind::Undone,      Kind::GamePhase};
static_assert(kindOfSimulated.size() == static_cast<std::size_t>(sim::EventKind::CoinToss) + 1);

/// In the order of sim::Setting.
constexpr const char* settingLabels[] = {"noise", "physics", "rules", "score and clock"};
static_assert(std::size(settingLabels) ==
              static_cast<std::size_t>(sim::Setting::ScoreAndClock) + 1);

}  // namespace

MatchEvent matchEvent(const sim::Event& event, const sim::WorldState& state) {
  MatchEvent out;
  const auto robot = std::find_if(state.robots.begin(), state.robots.end(),
                                  [&](const auto& r) { return r.id == event.robot; });
  const double time = static_cast<double>(event.tick) / state.settings.tickRate;
  if (robot != state.robots.end())
    out = eventOf(Kind::Other, time, uidOf(robot->id), robot->name());
  out.time = time;
  out.cause = event.cause;
  out.kind = kindOfSimulated[static_cast<std::size_t>(event.kind)];
  switch (event.kind) {
    case sim::EventKind::Goal:
    case sim::EventKind::ScoreCorrected:
      out.side = event.value == 0 ? Side::Left : Side::Right;
      setTeam(teamOn(*out.side, state.robots), state, out);
      out.score = state.score;
      break;
    case sim::EventKind::Kick:
    case sim::EventKind::UnknownAction:
    case sim::EventKind::HalfBegan:
      out.value = event.value;
      break;
    case sim::EventKind::PlayStateChanged:
      out.state = static_cast<PlayState>(event.value);
      out.detail = labelOf(*out.state);
      if (state.game) {
        out.value = static_cast<int>(std::ceil(state.game->clock / state.settings.tickRate - 1e-9));
      }
      break;
    case sim::EventKind::PhaseChanged:
      if (event.value != 0) out.detail = labelOf(static_cast<GamePhase>(event.value));
      break;
    case sim::EventKind::SetPlayBegan:
      out.detail = std::string(labelOf(static_cast<SetPlay>(event.value))) + sideWithBall(state);
      break;
    case sim::EventKind::DropBall:
      out.detail = "drop ball";
      break;
    case sim::EventKind::Penalised:
      out.detail = labelOf(static_cast<PenaltyKind>(event.value));
      break;
    case sim::EventKind::SettingChanged:
      out.detail = settingLabels[event.value];
      break;
    case sim::EventKind::FinalWhistle:
      out.detail = "final whistle";
      break;
    case sim::EventKind::CoinToss:
      if (state.game) {
        setTeam(state.game->teams[static_cast<std::size_t>(event.value)].colour, state, out);
      }
      out.detail = "a coin decides the shoot-out for " + teamText(out);
      break;
    default:
      break;
  }
  return out;
}

void dropUndone(std::vector<MatchEvent>& events) {
  std::vector<MatchEvent> kept;
  kept.reserve(events.size());
  for (MatchEvent& event : events) {
    if (event.kind != Kind::Undone) {
      kept.push_back(std::move(event));
      continue;
    }
    std::erase_if(kept, [&event](const MatchEvent& before) {
      return before.cause != 0 && before.cause == event.cause;
    });
  }
  events = std::move(kept);
}

std::string sentenceOf(const MatchEvent& event) {
  const std::string subject = subjectOf(event);
  return subject.empty() ? predicateOf(event) : subject + ' ' + predicateOf(event);
}

std::string labelOf(const MatchEvent& event) {
  if (!info(event.kind).labelled) return {};
  switch (event.kind) {
    case Kind::Goal: {
      const std::string team = !event.colour && event.team == 0 && event.side
                                   ? std::string(sideName(*event.side))
                                   : teamText(event);
      return team.empty() ? "goal" : "goal " + team;
    }
    case Kind::MatchOver:
      return "FINISHED";
    default:
      return event.detail;
  }
}

LogLine logLineOf(const MatchEvent& event) {
  const std::string subject = subjectOf(event);
  const MatchEventInfo& kind = info(event.kind);
  // A goal of a match without a referee has no team number.
  const bool refereed = event.kind == Kind::Goal && event.team != 0;
  const std::string_view origin = refereed ? "referee" : kind.origin;
  return {event.time, subject.empty() ? std::string(origin) : subject, predicateOf(event),
          logLevel(kind.warning), event.cause};
}

}  // namespace pitchboard::link
