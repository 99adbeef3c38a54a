// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The passes and shots of a simulated match as the simulation knows them: each kick command, the
// velocity that it gave the ball, and who touches the ball after it, tick by tick. Compares them
// with what a tally finds. Shared by the test and the benchmark of plays; one thread; metres,
// seconds. docs/statistics.md has the definitions, which this follows on its own.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <frame_builder.h>

#include <robotlink/match/simulated_match.h>
#include <robotlink/report/session_tally.h>
#include <robotlink/session/match_sampler.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

struct TruePlay {
  PlayKind kind = PlayKind::Pass;
  bool isCompleted = false;  ///< of a pass
  double time = 0.0;
  std::string name, other;
  bool isOnBorder = false;  ///< of the definition: whether it is one, or a shot, is a matter of cm
};

class PlayTruth {
 public:
  /// After every tick.
  void ticked(const SimulatedMatch& match) {
    const sim::Simulation& simulation = match.simulation();
    const sim::WorldState& world = simulation.state();
    simulation.snapshot(m_now);
    const bool inPlay = !world.game || isInPlay(*world.game);
    std::size_t kicker = m_now.robots.size();
    for (const sim::Event& event : simulation.events()) {
      for (std::size_t i = 0; event.kind == sim::EventKind::Kick && i < m_now.robots.size(); ++i) {
        if (m_now.robots[i].identity.id == event.robot) kicker = i;
      }
    }
    const bool isGoal = std::ranges::any_of(simulation.events(), [](const sim::Event& event) {
      return event.kind == sim::EventKind::Goal;
    });
    if (m_kick && isGoal && !m_kick->isAway) {  // so near that it is in at once
      m_kick->isAway = m_kick->isShot = true;
      m_kick->play.isOnBorder = false;
    }
    const bool jumped = m_kick && distance(m_last, m_now.ball) > 0.5;
    if (m_kick && (!inPlay || jumped || isGoal)) {
      if (!m_kick->isAway && distance(m_kick->from, m_last) > 0.01)
        leave(match, m_last, m_lastVelocity);
      end(nullptr);
    }
    const std::size_t toucher = kicker < m_now.robots.size() ? kicker : toucherOf(world);
    const bool touches = toucher < m_now.robots.size();
    if (m_kick && !m_kick->isAway && distance(m_kick->from, m_now.ball) >= 0.5) {
      leave(match, m_now.ball, m_now.ballVelocity);
    }
    if (m_kick && touches && m_kick->isAway) {
      end(&m_now.robots[toucher]);
    } else if (m_kick && touches && m_now.time - m_kick->play.time > 0.3 &&
               m_now.robots[toucher].identity.name() != m_kick->play.name) {
      drop();  // somebody has taken the ball where it lay
    }
    if (m_kick && m_now.time - m_kick->play.time > 16.0) m_kick.reset();
    if (kicker < m_now.robots.size() && (isGoal || distance(m_last, m_now.ball) > 0.5)) {
      // In the goal, or out, within the tick of the kick: only a goal says where it went.
      m_plays.push_back(
          {PlayKind::Shot, false, m_now.time, m_now.robots[kicker].identity.name(), {}, !isGoal});
    } else if (kicker < m_now.robots.size() && inPlay) {
      begin(m_now.robots[kicker]);
    }
    m_last = m_now.ball;
    m_lastVelocity = m_now.ballVelocity;
  }
  const std::vector<TruePlay>& plays() const { return m_plays; }

 private:
  struct Kick {
    TruePlay play;
    sim::RobotIdentity robot;
    Point from;
    bool isAway = false, isShot = false;
  };
  static bool isInPlay(const Game& game) {
    return game.state == PlayState::Playing && !game.stopped && game.phase != GamePhase::ShootOut;
  }
  std::size_t toucherOf(const sim::WorldState& world) const {
    std::size_t found = m_now.robots.size();
    double least = 0.012;
    for (std::size_t i = 0; i < m_now.robots.size(); ++i) {
      const double gap = distance(m_now.robots[i].pose.position, m_now.ball) -
                         sim::robotRadius(world, i) - world.settings.field.ballRadius;
      if (gap >= least) continue;
      least = gap;
      found = i;
    }
    return found;
  }
  /// No play, but maybe nearly one.
  void drop() {
    m_kick->play.isOnBorder = distance(m_kick->from, m_now.ball) > 0.4;
    if (m_kick->play.isOnBorder) m_plays.push_back(m_kick->play);
    m_kick.reset();
  }
  void begin(const sim::RobotSnapshot& robot) {
    m_kick = Kick{
        {PlayKind::Pass, false, m_now.time, robot.identity.name(), {}}, robot.identity, m_now.ball};
  }
  /// The ball has rolled half a metre: where to, and how far would it roll?
  void leave(const SimulatedMatch& match, const Point& ball, const Velocity& velocity) {
    m_kick->isAway = true;
    const sim::WorldState& world = match.simulation().state();
    const sim::FieldSpec& field = world.settings.field;
    bool right = !m_kick->robot.imuStartsAt180;
    if (world.game) {
      right = world.game->attacksRight(
          static_cast<std::size_t>(world.game->teamOf(m_kick->robot.team)));
    }
    const Point& from = m_kick->from;
    const Point moved{ball.x - from.x, ball.y - from.y};
    const double toLine = (right ? 1.0 : -1.0) * field.halfLength() - from.x;
    if (moved.x * toLine <= 0.0) return;
    const double y = from.y + toLine / moved.x * moved.y;
    const double way = toLine / moved.x * length(moved);
    const double speed = std::hypot(velocity.x, velocity.y);
    const double beside = std::abs(y) - field.goalWidth / 2.0 - 0.5;
    const double spare = length(moved) + sim::rollingDistance(field.surface, speed) - way;
    m_kick->isShot = beside <= 0.0 && spare >= 0.0;
    m_kick->play.isOnBorder = (m_kick->isShot && std::max(beside, -spare) > -0.1) ||
                              (!m_kick->isShot && std::max(beside, -spare) < 0.1);
  }
  void end(const sim::RobotSnapshot* toucher) {
    Kick kick = *m_kick;
    m_kick.reset();
    if (!kick.isAway) return;
    const std::string name = toucher ? toucher->identity.name() : "";
    if (name == kick.play.name) return;
    kick.play.isOnBorder |=
        m_now.time - kick.play.time > 14.0 || (toucher && distance(kick.from, m_last) < 0.6);
    kick.play.other = name;
    kick.play.isCompleted = toucher && toucher->identity.team == kick.robot.team;
    if (kick.isShot && !kick.play.isCompleted) {
      kick.play.kind = PlayKind::Shot;
    } else if (!toucher) {
      return;
    }
    m_plays.push_back(kick.play);
  }

  sim::Snapshot m_now;
  std::optional<Kick> m_kick;
  Point m_last;
  Velocity m_lastVelocity;
  std::vector<TruePlay> m_plays;
};

/// What was there, what of it was found, and what was invented.
struct PlayScore {
  int truth = 0, found = 0, invented = 0;
  double foundShare() const { return truth > 0 ? double(found) / truth : 1.0; }
  /// Of all that were reported.
  double inventedShare() const {
    return found + invented > 0 ? double(invented) / (found + invented) : 0.0;
  }
};

struct PlayScores {
  PlayScore completed, intercepted, shots;
  int onBorder = 0;  ///< that count neither way
};

/// A play is found if its kind, robots and time (within half a second) agree.
inline void compare(const std::vector<TruePlay>& truth, const std::vector<PlayEvent>& found,
                    PlayScores& out, const char* tell = nullptr) {
  const auto scoreOf = [&out](PlayKind kind, bool completed) -> PlayScore& {
    return kind == PlayKind::Shot ? out.shots : completed ? out.completed : out.intercepted;
  };
  std::vector<const PlayEvent*> left;
  for (const PlayEvent& play : found) {
    if (play.kind == PlayKind::Shot ||
        (play.kind == PlayKind::Pass && play.outcome != PlayOutcome::Out)) {
      left.push_back(&play);
    }
  }
  for (const TruePlay& play : truth) {
    if (play.isOnBorder) {
      std::erase_if(left, [&play](const PlayEvent* other) {
        return other->name == play.name && std::abs(other->time - play.time) <= 0.5;
      });
      ++out.onBorder;
      continue;
    }
    PlayScore& score = scoreOf(play.kind, play.isCompleted);
    ++score.truth;
    const auto same = std::ranges::find_if(left, [&play](const PlayEvent* other) {
      return other->kind == play.kind && other->name == play.name &&
             (play.kind == PlayKind::Shot || other->otherName == play.other) &&
             std::abs(other->time - play.time) <= 0.5;
    });
    if (same == left.end()) {
      if (tell) {
        std::printf("%s missed %s %.2f %s %s\n", tell,
                    play.kind == PlayKind::Shot ? "shot" : "pass", play.time, play.name.c_str(),
                    play.other.c_str());
      }
      continue;
    }
    ++score.found;
    left.erase(same);
  }
  for (const PlayEvent* play : left) {
    ++scoreOf(play->kind, play->outcome == PlayOutcome::Completed).invented;
    if (tell) {
      std::printf("%s invented %s %.2f to %.2f %s\n", tell, std::string(nameOf(play->kind)).c_str(),
                  play->time, play->end, sentenceOf(*play).c_str());
    }
  }
}

/// A match, and what tallies find in it: with the robots' counters of kicks, from places alone, and
/// from what robots believe and see.
struct PlayTrial {
  explicit PlayTrial(SimulatedMatch& match, double seconds)
      : places(match.scenario().settings.field), beliefs(match.scenario().settings.field) {
    const sim::FieldSpec field = match.scenario().settings.field;
    const auto tally = std::make_shared<RowTally>(field);
    MatchSampler sampler(tally, {6});
    sampler.ticked(match, {});
    FrameBuilder frames;
    for (int tick = 1; tick <= static_cast<int>(60.0 * seconds) && !match.finished(); ++tick) {
      match.tick();
      truth.ticked(match);
      sampler.ticked(match, std::chrono::nanoseconds(1000));
      if (tick % 6 == 0) takeFrame(match, frames);
    }
    const telemetry::TimeRange range{0.0, match.simulation().snapshot().time};
    compare(truth.plays(), tally->statistics(range).plays, withCounters, tell);
    compare(truth.plays(), places.statistics(range).plays, withPlaces);
    compare(truth.plays(), beliefs.statistics(range).plays, withBeliefs);
  }

  /// The same frame without counters, and as a live one, in which robots are where they believe.
  void takeFrame(SimulatedMatch& match, FrameBuilder& frames) {
    MatchFrame frame;
    frames.fill(match, {}, false, frame);
    MatchFrame live = frame;
    for (RobotFrame& robot : live.robots) {
      robot.link = telemetry::LinkHealth{};
      if (robot.belief) robot.pose = *robot.belief;
    }
    TallyMoment believed = liveMomentOf(live);
    TallyMoment placed = believed;
    placed.ball = frame.snapshot.ball;
    placed.ballSigma = 0.0;
    for (std::size_t i = 0; i < placed.robots.size(); ++i) {
      TallyRobot& robot = placed.robots[i];
      robot.place = frame.robots[i].pose.position;
      robot.ballDistance = distance(*robot.place, *placed.ball);
      robot.link.reset();
      robot.kicking = robot.tellsKicks = false;
      robot.sigma = 0.0;
    }
    if (!frame.game) {
      for (TallyMoment* moment : {&believed, &placed}) {
        for (const RobotFrame& robot : frame.robots) {
          moment->teams[robot.identity.team].attacksRight = !robot.identity.imuStartsAt180;
        }
      }
    }
    beliefs.add(believed);
    places.add(placed);
  }

  static inline const char* tell = nullptr;
  PlayTruth truth;
  MatchTally places, beliefs;
  PlayScores withCounters, withPlaces, withBeliefs;
};

}  // namespace pitchboard::link
