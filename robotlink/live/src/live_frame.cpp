// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_frame.h"

#include <algorithm>
#include <cmath>

#include <robotlink/frame/build_robot.h>
#include <robotlink/frame/second_sender.h>
#include <robotlink/live/live_teams.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;
using telemetry::RefereePlayer;
using telemetry::RefereeState;
using telemetry::RefereeTeam;
using telemetry::RobotStatus;

std::vector<HeardValue> valuesOf(const RobotStatus& robot) {
  std::vector<HeardValue> values;
  values.reserve(robot.words.size());
  const auto& fields = robot.decoder->profile().fields;
  for (std::size_t i = 0; i < robot.words.size(); ++i) {
    values.push_back({robot.decoder->name(i), telemetry::printable(robot.words[i], 40),
                      i < fields.size() ? fields[i].unit : std::string()});
  }
  return values;
}

std::optional<Penalty> penaltyOf(const RefereeState* state, int ourTeam, int number) {
  const RefereeTeam* team = state == nullptr ? nullptr : state->team(ourTeam);
  if (team == nullptr) return std::nullopt;
  for (const RefereePlayer& player : team->players()) {
    if (player.number != number || player.penalty == 0 || player.unreliable ||
        telemetry::isSubstitute(*state, player)) {
      continue;
    }
    return Penalty{std::string(telemetry::penaltyWords(*state, player.penalty)),
                   player.secondsLeft};
  }
  return std::nullopt;
}

/// The set play and the phase in words. One version says in one field what another says in two.
void describeSetPlay(const RefereeState& state, std::string& setPlay, std::string& phase) {
  constexpr int normal = 0, shootout = 1, overtime = 2;
  if (state.secState && *state.secState != normal) {
    const std::string words(telemetry::setPlayWords(telemetry::League::Humanoid, *state.secState));
    (*state.secState == overtime || *state.secState == shootout ? phase : setPlay) = words;
  }
  if (state.gamePhase && *state.gamePhase != 0) {
    phase = telemetry::gamePhaseWords(*state.gamePhase);
  }
  if (state.setPlay && *state.setPlay != 0) {
    setPlay = telemetry::setPlayWords(state.league, *state.setPlay);
  }
}

/// Who takes the set play and how far it is (docs/LIVE.md, "Referee").
void describeTaking(const RefereeState& state, RefereeView& view) {
  constexpr int firstOfSetPlays = 4;       // of the secondary state: free kicks and what follows
  constexpr int sizeWithThreeSteps = 688;  // until 2018 there were two, counted the other way
  if (state.secState && *state.secState >= firstOfSetPlays && *state.secState < 255 &&
      state.secStateInfo) {
    const auto& info = *state.secStateInfo;
    if (state.team(info[0]) != nullptr) view.performingTeam = info[0];
    if (state.size >= sizeWithThreeSteps) {
      view.setPlayStep = info[1] == 0 ? "stop" : info[1] == 1 ? "prepare" : "ready";
    } else {
      view.setPlayStep = info[1] == 1 ? "stop" : "prepare";
    }
  } else if (state.setPlay.value_or(0) != 0) {
    view.performingTeam = state.kickOffTeam;
    if (view.stopped) view.setPlayStep = "stop";
  }
}

/// What the secondary time counts down to.
std::string countdownOf(const RefereeView& view) {
  if (view.secondaryTime.value_or(0) == 0) return {};
  if (view.setPlay == "timeout" || view.phase == "timeout") return "timeout over";
  if (view.state == "READY") return "set";
  if (view.state == "INITIAL" || view.state == "FINISHED") return "next half";
  if (view.setPlay.empty()) return view.state == "PLAYING" ? "ball free" : "";
  return view.setPlayStep == "prepare" ? "ready" : "ball free";
}

RefereeTeamView teamView(const RefereeState& state, const RefereeTeam& team) {
  RefereeTeamView view{
      team.number, std::string(telemetry::colourWords(team.colour)), team.score, 0, {}};
  for (const RefereePlayer& player : team.players()) {
    // Slots without a player are substitutes, and so are those who wait.
    if (player.unreliable || telemetry::isSubstitute(state, player)) continue;
    view.playersLeft += player.penalty == 0 ? 1 : 0;
    view.players.push_back(
        {player.number, std::string(telemetry::penaltyWords(state, player.penalty)),
         player.secondsLeft, player.warnings.value_or(0), player.yellow.value_or(0),
         player.red.value_or(0), player.cautions.value_or(0),
         player.goalkeeper.value_or(0) != 0 || team.goalkeeper == player.number});
  }
  return view;
}

std::optional<RefereeTruth> truthOf(const telemetry::RefereeTracker& tracker,
                                    telemetry::WallTime now) {
  if (!tracker.trueData()) return std::nullopt;
  const RefereeState& state = *tracker.trueData();
  RefereeTruth truth;
  truth.state = telemetry::stateName(state.state);
  std::string phase;
  describeSetPlay(state, truth.setPlay, phase);
  if (truth.setPlay.empty()) truth.setPlay = phase;
  truth.secondsLeft = state.secsRemaining;
  truth.secondaryTime = state.secondaryTime;
  truth.scores = {state.teams[0].score, state.teams[1].score};
  truth.age = telemetry::secondsOf(std::max(now - tracker.trueDataTime(), telemetry::Duration{}));
  return truth;
}

std::vector<RobotReplyView> repliesOf(const telemetry::RefereeTracker& tracker,
                                      telemetry::WallTime now) {
  constexpr double metres = 0.001;
  std::vector<RobotReplyView> views;
  for (const auto& [reply, robot, time] : tracker.replies()) {
    RobotReplyView& view = views.emplace_back();
    view.team = reply.team;
    view.player = reply.player;
    view.address = robot.text();
    view.fallen = reply.fallen.value_or(0) != 0;
    if (reply.pose && std::ranges::all_of(*reply.pose, [](float f) { return std::isfinite(f); })) {
      const auto& [x, y, yaw] = *reply.pose;
      view.pose = Pose{{static_cast<double>(x) * metres, static_cast<double>(y) * metres},
                       static_cast<double>(yaw)};
    }
    if (reply.ballAge && *reply.ballAge >= 0.0F && std::isfinite(*reply.ballAge)) {
      view.ballAge = static_cast<double>(*reply.ballAge);
    }
    view.age = telemetry::secondsOf(std::max(now - time, telemetry::Duration{}));
  }
  return views;
}

RefereeView viewOf(const telemetry::RefereeTracker& tracker, int ourTeam, telemetry::WallTime now) {
  const RefereeState& state = *tracker.state();
  RefereeView view;
  view.version = state.version;
  view.sender = tracker.sender()->text();
  view.age = telemetry::secondsOf(*tracker.age(now));
  view.timedOut = tracker.timedOut(now);
  view.conflict = tracker.conflict(now);
  view.truth = truthOf(tracker, now);
  view.replies = repliesOf(tracker, now);
  view.state = telemetry::stateName(state.state);
  describeSetPlay(state, view.setPlay, view.phase);
  view.firstHalf = state.firstHalf != 0;
  view.stopped = state.stopped.value_or(0) != 0;
  view.secondsLeft = state.secsRemaining;
  view.secondaryTime = state.secondaryTime;
  describeTaking(state, view);
  view.countdown = countdownOf(view);
  view.kickOffTeam = state.kickOffTeam;
  for (std::size_t i = 0; i < view.teams.size(); ++i) {
    view.teams[i] = teamView(state, state.teams[i]);
  }
  view.ourTeam = state.team(ourTeam) != nullptr ? ourTeam : 0;
  return view;
}

}  // namespace

std::optional<TeamColor> teamColour(std::string_view words) {
  for (const TeamColorInfo& known : teamColors) {
    if (known.name == words) return known.color;
  }
  return std::nullopt;
}

MatchFrame liveFrame(const LiveOptions& options, const telemetry::TeamStatus& team,
                     const telemetry::RefereeTracker& referee, double time) {
  MatchFrame frame;
  frame.origin = FrameOrigin::Live;
  frame.truthKnown = false;
  frame.ballKnown = false;
  FrameSettings settings;
  settings.field = options.field;
  frame.settings = std::make_shared<const FrameSettings>(std::move(settings));
  frame.snapshot.time = time;
  frame.speed = 1.0;
  TeamColor ours = options.colour;
  const RefereeState* state = referee.state() ? &*referee.state() : nullptr;
  if (state != nullptr) {
    frame.referee = viewOf(referee, options.ourTeam, team.time);
    frame.snapshot.score = {frame.referee->teams[0].score, frame.referee->teams[1].score};
    frame.snapshot.clock = frame.referee->secondsLeft;
    frame.snapshot.clockRunning = frame.referee->state == "PLAYING" && !frame.referee->timedOut;
    for (const RefereeTeamView& side : frame.referee->teams) {
      if (side.number == frame.referee->ourTeam && side.number != 0) {
        ours = teamColour(side.colour).value_or(ours);
      }
    }
  }
  frame.robots.reserve(team.robots.size());
  for (const RobotStatus& robot : team.robots) {
    RobotFrame& out = frame.robots.emplace_back();
    out.identity.id = idOfSlot(robot.number, robot.slot);
    out.identity.number = telemetry::numberInTeam(robot.number, options.team.teams.size());
    out.identity.team = colourOf(options, robot.number, ours, frame.referee);
    out.ownName = ownNameOf(options, robot.number);
    out.link = robot;
    out.lamps = robot.processes;
    out.penalty = penaltyOf(state, refereeNumberOf(options, robot.number), out.identity.number);
    out.values = valuesOf(robot);
    const RobotReader reader = [&robot](FieldMeaning meaning) {
      // The decoder has left out a ball that is not seen.
      return meaning == FieldMeaning::BallSeen ? std::nullopt : robot.value(meaning);
    };
    buildRobot(reader, options.field, false, out);
    out.battery = robot.battery;
    out.action = out.decided.value_or(0);
  }
  frame.teamBalls = agreedBalls(frame.robots);
  return frame;
}

}  // namespace pitchboard::link
