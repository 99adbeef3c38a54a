// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the parts of the rigid-body model hand to each other during one tick: the world that is
// being advanced, and per robot what control asked for and what collisions made of it. Metres,
// radians, seconds. Scratch memory of a thread; nothing here outlives a tick but the memory itself
// and the sine and cosine of a yaw, which are remembered by its bits.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <base/angles.h>
#include <base/random_batch.h>
#include <base/repeatable_math.h>
#include <simcore/world/ball_sweep.h>
#include <simcore/world/event.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim::rigid {

/// Cosine and sine of the last yaw asked for; computed again only when its bits change.
class Heading {
 public:
  void set(double yaw) {
    if (std::bit_cast<std::uint64_t>(yaw) == std::bit_cast<std::uint64_t>(m_yaw)) return;
    m_yaw = yaw;
    const repeatable::SinCos both = repeatable::sinCos(yaw);
    m_cos = both.cos;
    m_sin = both.sin;
  }
  double cos() const { return m_cos; }
  double sin() const { return m_sin; }

 private:
  double m_yaw = std::numeric_limits<double>::quiet_NaN();
  double m_cos = 1.0;
  double m_sin = 0.0;
};

/// One robot's motion in this tick.
struct Motion {
  Heading heading;        ///< after this tick's turn
  double forward = 0.0;   ///< m/s at the start of the tick, for the accelerometer
  double sideways = 0.0;  ///< m/s at the start of the tick
  double turned = 0.0;    ///< rad turned in this tick, noise included
  Velocity velocity;      ///< m/s that the gait asks for, in the field's frame
  Point noise;            ///< m by which noise displaces the robot in this tick
  // Of what it runs into in this tick; 0 where robots cannot fall.
  Velocity push;     ///< N·s that tip it over
  Velocity stopped;  ///< m/s that it loses, or gains
};

/// The random numbers of one stream: of this tick, or drawn ahead for ticks of many worlds.
class DrawnStream {
 public:
  DrawnStream(NoiseStream stream, int count) : m_stream(stream), m_count(count) {}

  void drawAhead(std::span<const RandomBatch::Tick> ticks, std::span<const int> robots) {
    m_ticks.assign(ticks.begin(), ticks.end());
    m_robots.assign(robots.begin(), robots.end());
    m_at = 0;
    m_batch.make(ticks, m_stream, robots, m_count);
  }
  /// Draws those of this tick, unless they are there.
  void draw(const RandomBatch::Tick& tick, std::span<const int> robots) {
    if (std::ranges::equal(m_robots, robots)) {
      for (; m_at < m_ticks.size(); ++m_at) {
        if (m_ticks[m_at] == tick) return;
      }
    }
    drawAhead({&tick, 1}, robots);
  }
  /// Returns the numbers of a robot in the tick of the last draw().
  RandomBatch::Sequence of(std::size_t robot) const {
    return m_batch.of(m_at * m_robots.size() + robot);
  }

 private:
  NoiseStream m_stream;
  int m_count;  // numbers of each robot
  RandomBatch m_batch;
  std::vector<RandomBatch::Tick> m_ticks;
  std::vector<int> m_robots;
  std::size_t m_at = 0;  // in m_ticks
};

/// What noise all robots have in this tick, stream by stream; drawn where the stream is used first.
struct Noise {
  std::vector<int> robots;  ///< their numbers
  DrawnStream motion{NoiseStream::Motion, 3};
  DrawnStream imu{NoiseStream::Imu, 2};
  DrawnStream ball{NoiseStream::BallVision, 3};
  DrawnStream ballAsLandmark{NoiseStream::Landmarks, 2};
  // In this tick: only where somebody sees the ball.
  bool ballDrawn = false, ballAsLandmarkDrawn = false;
};

/// The tick that is being computed.
struct Tick {
  WorldState& world;
  RigidBodyState& state;
  std::vector<Motion>& motions;
  std::vector<Event>& events;
  Noise& batches;
  double dt = 0.0;          ///< s
  double sqrtFrames = 0.0;  ///< root of the tick in 1/60 s: scales noise given per 1/60 s
  BallSweep ball = {};      ///< set by the collisions

  const SimulationSettings& settings() const { return world.settings; }
  const RobotModel& model(std::size_t robot) const { return world.models[robot]; }
  const NoiseParameters& noise(std::size_t robot) const {
    return settings().noise.ofModel ? model(robot).noise : settings().noise;
  }
  /// Draws the numbers of this tick if the noise of at least one robot needs them; with `ahead`,
  /// those of other ticks, which need not be drawn again.
  template <class IsNoisy>
  void draw(DrawnStream& stream, const IsNoisy& isNoisy,
            std::span<const RandomBatch::Tick> ahead = {}) const {
    const std::size_t robots = world.robots.size();
    bool any = false;
    for (std::size_t i = 0; i < robots && !any; ++i) any = isNoisy(noise(i));
    if (!any) return;
    batches.robots.resize(robots);
    for (std::size_t i = 0; i < robots; ++i) batches.robots[i] = world.robots[i].id.value;
    if (ahead.empty()) {
      stream.draw({settings().seed, world.tick}, batches.robots);
    } else {
      stream.drawAhead(ahead, batches.robots);
    }
  }
  void report(EventKind kind, std::size_t robot, int value = 0) {
    events.push_back({kind, world.tick, world.robots[robot].id, value});
  }
};

/// The same direction in (−π, π], never −0.
inline double wrapped(double angle) {
  return wrapToPi(angle) + 0.0;
}

}  // namespace pitchboard::sim::rigid
