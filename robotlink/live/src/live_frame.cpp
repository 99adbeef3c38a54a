// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_frame.h"

#include <algorithm>
#include <cmath>

#include <robotlink/frame/belief.h>
#include <robotlink/frame/referee_view.h>
#include <robotlink/live/live_teams.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

using telemetry::FieldMeaning;
using telemetry::RefereeState;
using telemetry::RobotStatus;

/// Sane numbers for drawing; what was sent stays in `values`.
constexpr double farAway_cm = 10'000.0;

double sane(double cm) {
  return std::clamp(cm, -farAway_cm, farAway_cm);
}

int asInt(std::optional<double> value) {
  constexpr double most = 2147483647.0;
  return value ? static_cast<int>(std::clamp(*value, -most, most)) : 0;
}

std::optional<Pose> poseOf(const RobotStatus& robot, const sim::FieldSpec& field) {
  const auto x = robot.value(FieldMeaning::X);
  const auto y = robot.value(FieldMeaning::Y);
  if (!x || !y) return std::nullopt;
  const double theta = std::fmod(robot.value(FieldMeaning::Theta).value_or(0.0), 360.0);
  return sim::published_frame::studioFromLocalization(field, {sane(*x), sane(*y), theta});
}

/// SYSTEM.md section 7: at distance BALL_DIST and angle THETA + BALL_ANGLE; -1 is no ball.
std::optional<Point> ballOf(const RobotStatus& robot, const Pose& pose,
                            const sim::FieldSpec& field) {
  const auto distance = robot.value(FieldMeaning::BallDistance);
  const auto angle = robot.value(FieldMeaning::BallAngle);
  if (!distance || !angle) return std::nullopt;
  return ballSeenFrom(pose, *distance, *angle, field);
}

std::vector<HeardValue> valuesOf(const RobotStatus& robot) {
  std::vector<HeardValue> values;
  values.reserve(robot.words.size());
  const auto& fields = robot.decoder->profile().fields;
  for (std::size_t i = 0; i < robot.words.size(); ++i) {
    values.push_back({robot.name(i), telemetry::printable(robot.words[i], 40),
                      i < fields.size() ? fields[i].unit : std::string()});
  }
  return values;
}

RobotHealth healthOf(const RobotStatus& robot) {
  RobotHealth health;
  static_cast<telemetry::LinkHealth&>(health) = robot;
  if (const auto action = robot.value(FieldMeaning::Action)) health.action = asInt(action);
  health.values = valuesOf(robot);
  return health;
}

RobotBoardView boardOf(const RobotStatus& robot) {
  RobotBoardView board;
  board.actionA = asInt(robot.value(FieldMeaning::Action));
  board.voltage = asInt(robot.value(FieldMeaning::Voltage));
  board.ballDistCm = static_cast<float>(robot.value(FieldMeaning::BallDistance).value_or(-1.0));
  board.visionLost = board.ballDistCm <= 0.0F;
  board.panDeg = static_cast<float>(robot.value(FieldMeaning::BallAngle).value_or(0.0));
  board.localizationX = asInt(robot.value(FieldMeaning::X));
  board.localizationY = asInt(robot.value(FieldMeaning::Y));
  board.localizationTheta = asInt(robot.value(FieldMeaning::Theta));
  board.belief = static_cast<float>(robot.value(FieldMeaning::Belief).value_or(0.0));
  const auto works = [&robot](std::size_t process) {
    return robot.processes[process].state == telemetry::ProcessState::Working;
  };
  board.controlWorking = works(0);
  board.visionWorking = works(1);
  board.localizationWorking = works(2);
  board.decisionWorking = works(3);
  board.imuWorking = works(4);
  return board;
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

/// As it is heard: from whom, how long ago, and what else is known.
RefereeView heardView(const telemetry::RefereeTracker& tracker, int ourTeam,
                      telemetry::WallTime now) {
  RefereeView view = viewOf(*tracker.state(), ourTeam);
  view.sender = tracker.sender()->text();
  view.age = telemetry::secondsOf(*tracker.age(now));
  view.timedOut = tracker.timedOut(now);
  view.conflict = tracker.conflict(now);
  view.replies = repliesOf(tracker, now);
  if (tracker.trueData()) {
    view.truth = truthOf(*tracker.trueData());
    view.truth->age =
        telemetry::secondsOf(std::max(now - tracker.trueDataTime(), telemetry::Duration{}));
  }
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
  frame.field = options.field;
  frame.snapshot.time = time;
  frame.speed = 1.0;
  TeamColor ours = options.colour;
  const RefereeState* state = referee.state() ? &*referee.state() : nullptr;
  if (state != nullptr) {
    frame.referee = heardView(referee, options.ourTeam, team.time);
    frame.snapshot.score = {frame.referee->teams[0].score, frame.referee->teams[1].score};
    frame.snapshot.clock = frame.referee->secondsLeft;
    frame.snapshot.clockRunning = frame.referee->state == "PLAYING" && !frame.referee->timedOut;
    for (RefereeTeamView& side : frame.referee->teams) {
      for (const telemetry::TeamSetup& setup : options.team.teams) {
        if (setup.number == side.number && side.number != 0) side.name = setup.name;
      }
      if (side.number == frame.referee->ourTeam && side.number != 0) {
        ours = teamColour(side.colour).value_or(ours);
      }
    }
  }
  std::vector<Point> balls;
  frame.robots.reserve(team.robots.size());
  for (const RobotStatus& robot : team.robots) {
    RobotFrame& out = frame.robots.emplace_back();
    out.key = robot.key;
    out.identity.id = {};
    out.identity.number = out.key.number;
    out.identity.team = colourOf(options, robot.key, ours, frame.referee);
    out.name = out.identity.name();
    out.ownName = ownNameOf(options, robot.key);
    RobotHealth& health = out.health.emplace(healthOf(robot));
    if (state != nullptr) {
      health.penalty = penaltyOf(*state, refereeNumberOf(options, robot.key), out.identity.number);
    }
    out.action = health.action.value_or(0);
    if (const auto pose = poseOf(robot, options.field)) {
      health.poseKnown = true;
      out.pose = *pose;
      out.headYaw = pose->yaw;
      health.ball = ballOf(robot, *pose, options.field);
    }
    out.board = boardOf(robot);
    if (const auto ball = perceivedBall(options.field, out)) balls.push_back(*ball);
  }
  frame.teamBall = agreedBall(balls);
  return frame;
}

}  // namespace pitchboard::link
