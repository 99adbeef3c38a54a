// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One sampled world of a rollout: bodies, ball and players, stepped a cycle of 0.1 s at a time. All
// of its memory is made by create(). Metres, radians, seconds, the studio's frame; one thread. Its
// functions stand in files by subject: percepts, motion, rules, and all the rest.

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <base/inline_vector.h>
#include <base/random_batch.h>
#include <robotlink/cognition/soccer_player.h>
#include <robotlink/rollout/rollouts.h>
#include <simcore/world/ball_rolling.h>

#include "belief_noise.h"

namespace pitchboard::rollout {

inline constexpr double cycleTime = link::SoccerPlayer::period;
inline constexpr double lyingTime = 0.5;  ///< s until control notices, as in the rigid-body model
inline constexpr int getUpFromFront = 15, getUpFromBack = 16;

inline double approached(double dx, double dy) {
  return std::sqrt(dx * dx + dy * dy);
}

/// What all worlds of a setup have in common.
struct RolloutConstants {
  struct Of {
    const sim::RobotModel* model = nullptr;
    sim::NoiseParameters noise;
    BeliefNoise belief;
    double radius = 0.0;
    double delayTicks = 0.0;  ///< of vision
  };

  static Result<std::shared_ptr<const RolloutConstants>> create(const Setup& setup);

  Setup setup;
  std::vector<Of> players;
  std::vector<link::SoccerPlayer> fresh;  ///< players at the beginning, before they know anything
  std::vector<int> drawers;               ///< whose noise is drawn: bodies, then senses
  int randomsPerCycle = 0;
  int ticksPerCycle = 2;
  double dt = 0.05;
  double sqrtFrames = 1.0;  ///< root of the tick in 1/60 s
  sim::RollingShare rolling;
  std::size_t moments = 2;  ///< that vision looks back
};

class RolloutWorld {
 public:
  static Result<RolloutWorld> create(std::shared_ptr<const RolloutConstants> constants);

  /// `trace` is empty or outlives the rollout; write() fills what is left of it.
  void begin(const Belief& belief, std::uint64_t seed, const PlayOptions& options,
             std::span<TracePoint> trace);
  /// False when the rollout has ended.
  bool cycle();
  void write(std::span<double> row);

 private:
  static constexpr std::size_t most = Rollouts::maxPlayers;

  struct Body {
    Pose pose;
    double cos = 1.0, sin = 0.0;
    double forward = 0.0, left = 0.0, turn = 0.0;  // the gait's speeds
    Velocity velocity;                             // that the gait asks for
    Velocity pushed;                               // by contacts in this tick
    bool touched = false;
    link::Act command, action;
    bool inMotion = false;
    double kickElapsed = -1.0;
    sim::Posture posture = sim::Posture::Upright;
    double getUpLeft = 0.0;
    double head = 0.0;  // relative to the body
    bool panRight = true, search = true, looksForOpponents = false;
    Point error;  // of its belief
    double yawError = 0.0, sigma = 0.1;
    bool isDown() const { return posture != sim::Posture::Upright; }
  };
  struct TeamReport {
    Point place;
    link::Intention intention = link::Intention::None;
    bool upright = true;
    std::optional<Point> ball;
  };
  struct Seen {  // as it was at a past moment
    Pose pose;
    double cos = 1.0, sin = 0.0, head = 0.0;
  };

  RolloutWorld() = default;
  const RolloutConstants::Of& of(std::size_t i) const { return m_constants->players[i]; }
  Side sideOf(std::size_t i) const { return m_constants->setup.players[i].side; }
  const sim::FieldSpec& field() const { return m_constants->setup.field; }
  double now() const { return static_cast<double>(m_tick) * m_constants->dt; }

  void sample(const Belief& belief);
  void replayPast(const Belief& belief);
  void decide();
  void drift(std::size_t i, RandomBatch::Sequence& random);
  void look(std::size_t i, RandomBatch::Sequence& random);
  void lookAtBall(std::size_t i, const Seen& image, const Point& lens,
                  RandomBatch::Sequence& random);
  void lookAtOpponents(std::size_t i, const Seen& image, const Point& lens);
  void searchWithHead(std::size_t i);
  void talk();
  void listen(std::size_t i);
  link::Referee refereeFor(std::size_t i) const;
  Pose believed(std::size_t i) const;

  void tick();
  void control(std::size_t i);
  void select(Body& body, int code, int b, bool inMotion) const;
  void stepDown(std::size_t i);
  void stepKick(std::size_t i);
  void kick(std::size_t i, int code);
  void walk(std::size_t i);
  void collide();
  void push(std::size_t i, const Point& away, double depth, double into, double otherMass);
  void rollBall();
  bool ballHits(const Point& at, double radius, const Point& path, double& share) const;
  void bounce(const Point& at, const Velocity& moving, double robotMass, double restitution,
              Velocity& velocity);
  void judge(const Point& before);
  void restart(const Point& ball);
  void traceUntil(std::size_t points);
  void remember();
  const Point& ballAt(std::size_t ticksAgo) const;
  const Seen& bodyAt(std::size_t ticksAgo, std::size_t i) const;
  Point ballRests() const;
  Point ballSeen(double ticksAgo) const;
  Seen bodySeen(double ticksAgo, std::size_t i) const;

  std::shared_ptr<const RolloutConstants> m_constants;
  std::vector<link::SoccerPlayer> m_soccerPlayers;
  InlineVector<std::size_t, most> m_here;  // players that are not absent
  std::array<Body, most> m_bodies;
  std::array<TeamReport, most> m_received, m_sent;
  std::vector<Point> m_pastBalls;
  std::vector<Seen> m_pastBodies;
  RandomBatch m_noise;
  std::vector<RandomBatch::Sequence> m_motionNoise;
  link::SoccerInput m_input;
  Point m_ball;
  Velocity m_ballVelocity;

  std::uint64_t m_seed = 1, m_tick = 0, m_cycle = 0, m_lastTick = 0, m_lookTick = 0;
  bool m_goOn = false;
  GameBelief m_game;
  Point m_setPlayBall;
  Ended m_ended = Ended::Time;
  bool m_over = false;
  int m_goalsLeft = 0, m_goalsRight = 0, m_lastTouch = -1;
  double m_timeToGoal = 0.0;
  Point m_look;
  bool m_looked = false;
  std::span<TracePoint> m_trace;
  std::size_t m_traced = 0;  // points that are there
  double m_traceTicks = 1.0;
};

}  // namespace pitchboard::rollout
