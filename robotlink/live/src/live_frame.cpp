// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_frame.h"

#include <algorithm>
#include <cmath>

#include <robotlink/frame/build_robot.h>
#include <robotlink/live/live_teams.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;
using telemetry::RobotStatus;

std::vector<ReceivedValue> valuesOf(const RobotStatus& robot) {
  std::vector<ReceivedValue> values;
  values.reserve(robot.texts.size());
  const auto& fields = robot.decoder->profile().fields;
  for (std::size_t i = 0; i < robot.texts.size(); ++i) {
    values.push_back({robot.name(i), telemetry::printable(robot.texts[i], 40),
                      i < fields.size() ? fields[i].unit : std::string()});
  }
  return values;
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

RefereeReception receptionOf(const telemetry::RefereeTracker& tracker, int ourTeam,
                             telemetry::WallTime now) {
  RefereeReception out;
  out.version = tracker.state()->version;
  out.size = tracker.state()->size;
  if (tracker.game()->teamNumbered(ourTeam) != Game::noTeam) out.ourTeam = ourTeam;
  out.sender = tracker.sender()->text();
  out.simulated = telemetry::isSimulated(tracker.sender()->address);
  out.age = telemetry::secondsOf(*tracker.age(now));
  out.timedOut = tracker.timedOut(now);
  out.conflict = tracker.conflict(now);
  out.replies = repliesOf(tracker, now);
  out.truth = tracker.trueGame();
  out.truthAge =
      telemetry::secondsOf(std::max(now - tracker.trueDataTime(), telemetry::Duration{}));
  return out;
}

}  // namespace

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
  frame.game = referee.game();
  frame.teams = teamsOf(options, frame.game);
  if (frame.game) {
    frame.reception = receptionOf(referee, ourNumber(options, frame.game), team.time);
    frame.snapshot.score = {frame.game->teamAt(false).score, frame.game->teamAt(true).score};
    frame.snapshot.clock = frame.game->secondsLeft();
    frame.snapshot.clockRunning =
        frame.game->state == PlayState::Playing && !frame.reception.timedOut;
  }
  frame.robots.reserve(team.robots.size());
  for (const RobotStatus& robot : team.robots) {
    RobotFrame& out = frame.robots.emplace_back();
    out.key = robot.key;
    out.identity.id = {};
    out.identity.number = out.key.number;
    out.identity.team = drawnColour(options, robot.key, frame.teams);
    out.name = robotName(robot.key, frame.teams);
    out.ownName = ownNameOf(options, robot.key);
    out.link = robot;
    out.lamps = robot.processes;
    if (frame.game) {
      const auto place = static_cast<std::size_t>(robot.key.team);
      const int number = place < frame.teams.size() ? frame.teams[place].number : 0;
      const int index = frame.game->teamNumbered(number);
      if (index != Game::noTeam) {
        const GameTeam& own = frame.game->teams[static_cast<std::size_t>(index)];
        out.penalty = penaltyOf(*frame.game, own.player(robot.key.number));
      }
    }
    out.values = valuesOf(robot);
    const RobotReader reader = [&robot](FieldMeaning meaning) {
      // The decoder has left out a ball that is not seen.
      return meaning == FieldMeaning::BallSeen ? std::nullopt : robot.value(meaning);
    };
    buildRobot(reader, options.field, options.team.battery, false, out);
    out.battery = robot.battery;
    out.action = out.decided.value_or(0);
  }
  frame.teamBalls = agreedBalls(frame.robots);
  frame.sortRobots();
  return frame;
}

}  // namespace pitchboard::link
