// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/follow_recording.h>

#include <algorithm>
#include <chrono>

#include <base/lined_json.h>
#include <base/try.h>
#include <robotlink/session/ball_sighting.h>

namespace pitchboard::link {
namespace {

class TrackCollector {
 public:
  TrackCollector(const Scenario& scenario, const FollowOptions& options)
      : m_scenario(scenario), m_options(options) {
    m_out.reach = options.reach;
    m_out.robots.resize(scenario.robots.size());
    for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
      m_out.robots[i].id = scenario.robots[i].identity.id;
    }
  }

  Result<void> choose(const std::string& who) {
    if (who == "ball") {
      m_out.ballFollows = true;
      return {};
    }
    std::vector<std::string_view> known{"ball"};
    std::vector<std::string> names;
    names.reserve(m_scenario.robots.size());  // `known` looks at them
    bool found = false;
    for (std::size_t i = 0; i < m_scenario.robots.size(); ++i) {
      const sim::RobotIdentity& robot = m_scenario.robots[i].identity;
      const std::string_view team = info(robot.team).name;
      if (std::ranges::find(known, team) == known.end()) known.push_back(team);
      known.push_back(names.emplace_back(robot.name()));
      if (who == names.back() || who == team) m_out.robots[i].follows = found = true;
    }
    if (found) return {};
    return failure(ErrorCode::NotFound, unknownName("robot, team or ball", who, known));
  }

  void take(const MatchFrame& frame) {
    for (const RobotFrame& robot : frame.robots) {
      if (!robot.poseKnown() || robot.timedOut()) continue;
      for (std::size_t i = 0; i < m_scenario.robots.size(); ++i) {
        const sim::RobotIdentity& known = m_scenario.robots[i].identity;
        if (known.team != robot.identity.team || known.number != robot.identity.number) continue;
        // A message tells where the robot was when it came.
        const double age = robot.link ? std::chrono::duration<double>(robot.link->age).count() : 0;
        add(m_out.robots[i].track, frame.snapshot.time - age, robot.pose);
        m_out.believed = m_out.believed || (m_out.robots[i].follows && !frame.truthKnown);
      }
    }
    if (frame.ballKnown) {
      add(m_out.ball, frame.snapshot.time, {frame.snapshot.ball, 0.0});
    } else if (const auto seen = ballSeenIn(frame)) {
      m_out.believed = m_out.believed || m_out.ballFollows;
      const auto& known = m_out.ball.poses;
      if (known.empty() || known.back().pose.position != seen->place) {
        add(m_out.ball, frame.snapshot.time, {seen->place, 0.0});
      }
    }
  }

  Result<FollowedRecording> finish() {
    if (m_out.ballFollows && m_out.ball.poses.empty()) {
      return failure(ErrorCode::NotFound,
                     "The ball cannot follow: no robot sees it in this part of the recording.");
    }
    for (std::size_t i = 0; i < m_out.robots.size(); ++i) {
      if (!m_out.robots[i].follows || !m_out.robots[i].track.poses.empty()) continue;
      return failure(ErrorCode::NotFound,
                     m_scenario.robots[i].identity.name() +
                         " cannot follow: its pose is unknown in this part of the recording.");
    }
    m_out.end = m_last;
    return std::move(m_out);
  }

 private:
  void add(RecordedTrack& track, double sourceTime, const Pose& pose) {
    const double time = sourceTime - m_options.from + m_options.matchTime;
    if (!track.poses.empty() && time <= track.poses.back().time + 1e-6) return;
    track.poses.push_back({time, pose});
    m_last = std::max(m_last, time);
  }

  const Scenario& m_scenario;
  const FollowOptions& m_options;
  FollowedRecording m_out;
  double m_last = 0.0;  // s of the match at which anything was recorded
};

}  // namespace

Result<FollowedRecording> recordingToFollow(
    const std::function<std::shared_ptr<const MatchFrame>(double time)>& frameAt,
    const Scenario& scenario, const FollowOptions& options) {
  TrackCollector tracks(scenario, options);
  for (const std::string& who : options.who) {
    TRY(tracks.choose(who));
  }
  const double rate = scenario.settings.tickRate;
  const auto ticks = static_cast<std::size_t>(std::max(0.0, options.until - options.from) * rate);
  for (std::size_t i = 0; i <= ticks; ++i) {
    const auto frame = frameAt(options.from + static_cast<double>(i) / rate);
    if (frame) tracks.take(*frame);
  }
  return tracks.finish();
}

}  // namespace pitchboard::link
