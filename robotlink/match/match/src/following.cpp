// SPDX-License-Identifier: GPL-3.0-or-later
#include "following.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <base/angles.h>
#include <simcore/world/places.h>

namespace pitchboard::link {
namespace {

constexpr double touchGap = 0.01;     // m between the surfaces of ball and robot
constexpr double fastestRoll = 15.0;  // m/s; a ball that seems faster was put elsewhere

double secondsOf(const sim::WorldState& state, std::uint64_t tick) {
  return static_cast<double>(tick) / state.settings.tickRate;
}

std::string nearText(const std::string& robot, double metres, const std::string& what) {
  char text[32];
  std::snprintf(text, sizeof text, " is %.2f m from ", metres);
  return robot + text + what;
}

}  // namespace

std::optional<Pose> RecordedTrack::at(double time) const {
  const auto after = std::ranges::upper_bound(poses, time, {}, &FollowedPose::time);
  if (after == poses.begin()) return {};
  const FollowedPose& from = *std::prev(after);
  if (after == poses.end()) return from.pose;
  const double start = std::max(from.time, after->time - longestMove);
  if (time <= start) return from.pose;
  const double share = (time - start) / (after->time - start);
  const Point& a = from.pose.position;
  const Point& b = after->pose.position;
  return Pose{{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)},
              wrapToPi(from.pose.yaw + share * wrapToPi(after->pose.yaw - from.pose.yaw))};
}

void Following::begin(std::shared_ptr<const FollowedRecording> recording) {
  m_recording = std::move(recording);
  m_state = {};
  m_ballTarget.reset();
  m_touched = false;
  m_ballFollows = m_recording && m_recording->ballFollows;
  m_state.follows = m_ballFollows || (m_recording && std::ranges::any_of(m_recording->robots,
                                                                         &FollowedRobot::follows));
}

void Following::placeRobots(sim::Simulation& simulation, double time) const {
  for (const FollowedRobot& robot : m_recording->robots) {
    if (!robot.follows) continue;
    if (const auto pose = robot.track.at(time)) (void)simulation.placeRobot(robot.id, *pose);
  }
}

void Following::place(sim::Simulation& simulation, std::span<sim::RobotCommand> commands) {
  m_state.moved = m_state.follows;
  m_ballTarget.reset();
  if (!m_state.follows) return;
  const sim::WorldState& state = simulation.state();
  const double begin = secondsOf(state, state.tick), end = secondsOf(state, state.tick + 1);
  placeRobots(simulation, end);
  for (const FollowedRobot& robot : m_recording->robots) {
    const auto index = simulation.indexOf(robot.id);
    if (robot.follows && index) commands[*index].actionA = commands[*index].actionB = 0;
  }
  const auto from = m_ballFollows ? m_recording->ball.at(begin) : std::nullopt;
  if (!from) return;
  m_ballTarget = m_recording->ball.at(end)->position;
  m_ballVelocity = {(m_ballTarget->x - from->position.x) / (end - begin),
                    (m_ballTarget->y - from->position.y) / (end - begin)};
  if (length({m_ballVelocity.x, m_ballVelocity.y}) <= fastestRoll) {
    (void)simulation.placeBall(from->position, m_ballVelocity);
  } else {
    // It was put there, as after a goal. It rolls on, so that the rules see the goal, too.
    m_ballVelocity = {};
  }
}

const FollowedRobot* Following::recorded(RobotId id) const {
  const auto found = std::ranges::find(m_recording->robots, id, &FollowedRobot::id);
  return found == m_recording->robots.end() ? nullptr : &*found;
}

bool Following::follows(RobotId id) const {
  const FollowedRobot* robot = recorded(id);
  return robot && robot->follows;
}

/// Returns whether a robot that does not follow touched or kicked the ball in the last step.
bool Following::isTouched(const sim::Simulation& simulation) const {
  const sim::Snapshot now = simulation.snapshot();
  const double ballRadius = simulation.state().settings.field.ballRadius;
  for (std::size_t i = 0; i < now.robots.size(); ++i) {
    if (follows(now.robots[i].identity.id)) continue;
    const double contact = sim::robotRadius(simulation.state(), i) + ballRadius + touchGap;
    if (distance(now.robots[i].pose.position, now.ball) <= contact) return true;
  }
  return std::ranges::any_of(simulation.events(), [this](const sim::Event& event) {
    return event.kind == sim::EventKind::Kick && !follows(event.robot);
  });
}

void Following::settleBall(sim::Simulation& simulation) {
  m_touched = m_touched || isTouched(simulation);
  m_ballFollows = m_ballFollows && !m_touched;
  if (m_ballFollows && m_ballTarget) (void)simulation.placeBall(*m_ballTarget, m_ballVelocity);
}

/// Returns what this robot is near enough to; empty if it is where it was recorded, or far away.
std::string Following::nearBy(const sim::RobotSnapshot& robot, const sim::Snapshot& now,
                              double time) const {
  const FollowedRobot* known = recorded(robot.identity.id);
  const auto pose = known ? known->track.at(time) : std::nullopt;
  const Point& place = robot.pose.position;
  if (pose && distance(pose->position, place) <= FollowedRecording::elsewhere) return {};
  const auto text = [&](double metres, const std::string& what) {
    return metres <= m_recording->reach ? nearText(robot.identity.name(), metres, what) : "";
  };
  std::string found = text(distance(place, now.ball), "the ball");
  for (const sim::RobotSnapshot& other : now.robots) {
    if (!found.empty()) break;
    if (!follows(other.identity.id)) continue;
    found = text(distance(place, other.pose.position), other.identity.name());
  }
  return found;
}

/// Returns an empty text if nothing has changed.
std::string Following::whyLetGo(const sim::Simulation& simulation, double time) const {
  if (time >= m_recording->end) return "its followed part ends";
  if (std::ranges::none_of(m_recording->robots, &FollowedRobot::follows)) {
    return m_ballFollows ? "" : "a robot touches the ball";
  }
  const sim::Snapshot now = simulation.snapshot();
  const auto ball = m_recording->ball.at(time);
  if (m_touched && ball && distance(now.ball, ball->position) > FollowedRecording::elsewhere) {
    return "the ball is elsewhere than recorded";
  }
  for (const sim::RobotSnapshot& robot : now.robots) {
    if (follows(robot.identity.id)) continue;
    if (std::string why = nearBy(robot, now, time); !why.empty()) return why;
  }
  return {};
}

bool Following::settle(sim::Simulation& simulation) {
  if (!m_state.follows) return false;
  const sim::WorldState& state = simulation.state();
  const double time = secondsOf(state, state.tick);
  placeRobots(simulation, time);
  settleBall(simulation);
  m_state.why = whyLetGo(simulation, time);
  if (m_state.why.empty()) return false;
  if (m_recording->believed) m_state.why += " (what was followed is what robots believed)";
  m_state.follows = m_ballFollows = false;
  m_state.letGoAt = time;
  return true;
}

}  // namespace pitchboard::link
