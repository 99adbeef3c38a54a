// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world_state.h>

#include <bit>
#include <string_view>

namespace pitchboard::sim {
namespace {

/// FNV-1a, 64 bits, over eight bytes a value (offset basis and prime: draft-eastlake-fnv).
class Hasher {
 public:
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      m_hash = (m_hash ^ (value & 0xff)) * 0x100000001b3ULL;
      value >>= 8;
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(bool value) { add(std::uint64_t{value}); }
  void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void add(std::uint32_t value) { add(std::uint64_t{value}); }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) add(static_cast<int>(c));
  }
  template <class... Values>
  void addAll(const Values&... values) {
    (add(values), ...);
  }
  std::uint64_t value() const { return m_hash; }

 private:
  std::uint64_t m_hash = 0xcbf29ce484222325ULL;
};

void add(Hasher& h, const FieldSpec& f) {
  h.addAll(std::string_view(f.name), f.length, f.width, f.border, f.goalWidth, f.goalDepth,
           f.goalHeight, f.goalPostRadius, f.goalAreaLength, f.goalAreaWidth, f.penaltyAreaLength,
           f.penaltyAreaWidth, f.penaltyMarkDistance, f.centreCircleDiameter, f.lineWidth,
           f.ballRadius, f.robotRadius);
}

void add(Hasher& h, const NoiseParameters& n) {
  h.addAll(n.forward, n.sideways, n.rotation, n.kickSpeed, n.kickAngle, n.visionDistance,
           n.visionBearing, n.robotDistance, n.robotBearing, n.landmarkBearing,
           n.landmarkProbability, n.missedDetection, n.visionDelay, n.imuWhite, n.imuDrift);
}

void add(Hasher& h, const RigidBodySettings& s) {
  h.addAll(s.maxAcceleration, s.maxYawAcceleration, s.robotMass, s.ballMass, s.ballFriction,
           s.postRestitution, s.robotRestitution, s.falls, s.fallImpulse, s.getUpTime, s.headSpeed,
           s.fieldOfView, s.panLimit, s.visionRange);
}

void add(Hasher& h, const PublishedState& state) {
  h.add(static_cast<std::uint64_t>(state.robots.size()));
  for (const PublishedRobot& r : state.robots) {
    h.addAll(r.x, r.y, r.rotate, r.view, r.panRight, r.action, r.front, r.turn, r.drift, r.inMotion,
             r.orientationError);
  }
  h.addAll(state.ball.x, state.ball.y, state.ball.vx, state.ball.vy, state.ball.friction);
}

void add(Hasher& h, const RigidBodyState& state) {
  h.add(static_cast<std::uint64_t>(state.robots.size()));
  for (const RigidRobot& r : state.robots) {
    h.addAll(r.pose.position.x, r.pose.position.y, r.pose.yaw, r.forwardSpeed, r.sidewaysSpeed,
             r.yawRate, r.velocity.x, r.velocity.y, r.headYaw, r.panRight, r.action, r.actionB,
             r.inMotion, static_cast<int>(r.posture), r.getUpRemaining, r.imuZero, r.imuDrift);
    h.add(static_cast<std::uint64_t>(r.sightings.size()));
    for (const BallSighting& s : r.sightings) h.addAll(s.seen, s.distance, s.bearing);
  }
  h.addAll(state.ball.position.x, state.ball.position.y, state.ball.velocity.x,
           state.ball.velocity.y);
}

}  // namespace

std::uint64_t stateHash(const WorldState& world) {
  Hasher h;
  const SimulationSettings& s = world.settings;
  h.addAll(std::string_view(s.physics), s.tickRate, s.seed, static_cast<int>(s.afterGoal));
  add(h, s.field);
  add(h, s.noise);
  add(h, s.rigidBody);
  h.addAll(world.tick, world.score.left, world.score.right, world.clockRunning, world.clockTicks);
  h.add(static_cast<std::uint64_t>(world.robots.size()));
  for (const RobotIdentity& r : world.robots) {
    h.addAll(r.id.value, static_cast<int>(r.team), r.number, r.imuStartsAt180);
  }
  for (const RobotStatistics& r : world.statistics) {
    h.addAll(r.distanceWalked, r.kicks, r.falls, r.unknownActions, r.lastUnknownAction);
  }
  std::visit([&h](const auto& physics) { add(h, physics); }, world.physics);
  return h.value();
}

}  // namespace pitchboard::sim
