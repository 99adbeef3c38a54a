// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigid_body_vision.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include <base/angles.h>
#include <base/random.h>
#include <simcore/world/published_frame.h>

#include "rigid_body_control.h"

namespace pitchboard::sim::rigid {
namespace {

constexpr int lookForBall = 0;
constexpr int lookForTeamMates = 1;
constexpr int lookForOpponents = 2;
constexpr int lookForBallAsLandmark = 0;  // DECISION_LOCALIZATION
constexpr int lookForCorners = 1;
constexpr double pointingTolerance = std::numbers::pi / 180.0;  // "±1°", as published
constexpr double landmarkHalfView = std::numbers::pi / 2.0;     // of the body, as published
constexpr double unseenLandmark = -999.0;
constexpr double unseenBall = -1.0;

struct Polar {
  double distance = 0.0;
  double bearing = 0.0;  // from the body's heading, left positive
};

/// What a robot's vision looks at: the world as it was when the image was taken.
class Image {
 public:
  Image(const Tick& tick, std::size_t index) : m_tick(tick), m_index(index) {
    const std::size_t delay = delayTicks(tick.world, index);
    const auto& past = tick.state.past;
    if (delay > 0) m_past = &past[(tick.world.tick + past.size() - delay) % past.size()];
    const RigidRobot& now = tick.state.robots[index];
    m_self = m_past ? m_past->robots[index] : PastRobot{true, isDown(now), now.pose, now.headYaw};
    const RobotModel& model = tick.model(index);
    m_camera = m_self.pose.position;
    if (model.cameraForward == 0.0) return;
    const repeatable::SinCos heading = repeatable::sinCos(m_self.pose.yaw);
    m_camera.x += model.cameraForward * heading.cos;
    m_camera.y += model.cameraForward * heading.sin;
  }

  /// Whether there is an image at all.
  bool taken() const { return m_self.there && !m_self.down; }
  double headYaw() const { return m_self.headYaw; }
  Point ball() const { return m_past ? m_past->ball : m_tick.state.ball.position; }
  /// Where another robot stood, if it was on the field.
  std::optional<Point> robot(std::size_t other) const {
    if (!m_past) return m_tick.state.robots[other].pose.position;
    const PastRobot& seen = m_past->robots[other];
    return seen.there ? std::optional<Point>(seen.pose.position) : std::nullopt;
  }

  /// From the lens, along the ground.
  Polar fromLens(const Point& place) const { return polar(m_camera, place); }
  /// Of the ball, which both landmark vision and ball vision look at.
  const Polar& ballFromLens() {
    if (!m_ball) m_ball = fromLens(ball());
    return *m_ball;
  }
  /// As vision tells it, of something whose middle is `height` above the ground.
  Polar reported(const Point& place, const Polar& seen, double height) const {
    const RobotModel& model = m_tick.model(m_index);
    if (!model.fromCamera) {
      return model.cameraForward == 0.0 ? seen : polar(m_self.pose.position, place);
    }
    return {repeatable::hypot(seen.distance, model.cameraHeight - height), seen.bearing};
  }

 private:
  Polar polar(const Point& from, const Point& place) const {
    const double dx = place.x - from.x;
    const double dy = place.y - from.y;
    return {repeatable::hypot(dx, dy), wrapped(repeatable::atan2(dy, dx) - m_self.pose.yaw)};
  }

  const Tick& m_tick;
  std::size_t m_index;
  const PastMoment* m_past = nullptr;  // none: what is seen is the present
  PastRobot m_self;
  Point m_camera;
  std::optional<Polar> m_ball;  // once it was asked for

  bool inRange(const Point& place) const {
    const RobotModel& model = m_tick.model(m_index);
    const double dx = place.x - m_camera.x;
    const double dy = place.y - m_camera.y;
    return dx * dx + dy * dy < model.visionRange * model.visionRange;
  }
  bool inField(const Polar& seen) const {
    return std::abs(wrapped(seen.bearing - headYaw())) < m_tick.model(m_index).fieldOfView / 2.0;
  }

 public:
  /// Where something stands if it is within range and field of view of the head.
  std::optional<Polar> inView(const Point& place, double height) const {
    if (!inRange(place)) return {};
    const Polar seen = fromLens(place);
    if (!inField(seen)) return {};
    return reported(place, seen, height);
  }
  std::optional<Polar> ballInView(double height) {
    if (!inRange(ball()) || !inField(ballFromLens())) return {};
    return reported(ball(), ballFromLens(), height);
  }
};

CounterRandom randomOf(const Tick& tick, std::size_t index, NoiseStream stream) {
  return {tick.settings().seed, tick.world.robots[index].id.value, stream, tick.world.tick};
}

void search(const Tick& tick, std::size_t index, RigidRobot& robot) {
  const RobotModel& model = tick.model(index);
  const double step = model.headSpeed * tick.dt;
  robot.headYaw += robot.panRight ? -step : step;
  if (std::abs(robot.headYaw) < model.panLimit) return;
  robot.headYaw = std::clamp(robot.headYaw, -model.panLimit, model.panLimit);
  robot.panRight = robot.headYaw > 0.0;
}

bool ballVisionIsNoisy(const NoiseParameters& noise) {
  return noise.missedDetection != 0.0 || noise.visionDistance != 0.0 || noise.visionBearing != 0.0;
}

std::optional<Polar> lookAtBall(const Tick& tick, std::size_t index, Image& image) {
  const auto seen = image.ballInView(tick.settings().field.ballRadius);
  if (!seen) return {};
  const NoiseParameters& noise = tick.noise(index);
  if (!ballVisionIsNoisy(noise)) return seen;
  if (!tick.batches.ballDrawn) {
    tick.draw(tick.batches.ball, ballVisionIsNoisy);
    tick.batches.ballDrawn = true;
  }
  RandomBatch::Sequence random = tick.batches.ball.of(index);
  if (random.uniform() < noise.missedDetection) return {};
  const double distance =
      std::max(0.0, random.normal(seen->distance, noise.visionDistance * seen->distance));
  return Polar{distance, wrapped(random.normal(seen->bearing, noise.visionBearing))};
}

/// Turns the head to what was seen; true when it points there.
bool follow(const Tick& tick, std::size_t index, RigidRobot& robot, double bearing) {
  const RobotModel& model = tick.model(index);
  const double goal = std::clamp(bearing, -model.panLimit, model.panLimit);
  const double step = model.headSpeed * tick.dt;
  robot.panRight = goal < robot.headYaw;
  robot.headYaw += std::clamp(goal - robot.headYaw, -step, step);
  return std::abs(goal - robot.headYaw) <= pointingTolerance;
}

void publishBall(const Tick& tick, std::size_t index, Image& image, const RobotCommand& command,
                 Percepts& percept) {
  const auto ball = lookAtBall(tick, index, image);
  percept.ball.lost = ball ? 0 : 1;
  if (!ball) return;
  percept.ball.distanceCm = published_frame::cmFromMetres(ball->distance);
  percept.ball.angleDeg = degreesFromRadians(ball->bearing);
  percept.ball.panDeg = percept.ball.angleDeg;
  RigidRobot& robot = tick.state.robots[index];
  if (follow(tick, index, robot, ball->bearing) && command.searchOn != 0) percept.searchOn = 0;
}

void lookAtRobots(const Tick& tick, std::size_t index, const Image& image, bool teamMates,
                  Percepts& percept) {
  const NoiseParameters& noise = tick.noise(index);
  CounterRandom random = randomOf(tick, index, NoiseStream::RobotVision);
  const std::size_t most = std::min<std::size_t>(tick.state.robots.size(), Percepts::maxSeenRobots);
  for (std::size_t other = 0; other < most; ++other) {
    const bool mate = tick.world.robots[other].team == tick.world.robots[index].team;
    if (other == index || mate != teamMates) continue;
    const auto place = image.robot(other);
    const auto seen = place ? image.inView(*place, 0.0) : std::nullopt;
    if (!seen) continue;
    if (noise.missedDetection > 0.0 && random.uniform() < noise.missedDetection) continue;
    const double distance = std::max(0.0, random.normal(seen->distance, noise.robotDistance));
    const double bearing = wrapped(random.normal(seen->bearing, noise.robotBearing));
    percept.robots[other] =
        SeenRobot{published_frame::cmFromMetres(distance), -degreesFromRadians(bearing)};
  }
}

void lookAtCorners(const Tick& tick, std::size_t index, const Image& image,
                   LandmarkPercept& percept) {
  const NoiseParameters& noise = tick.noise(index);
  const double x = tick.settings().field.halfLength();
  const double y = tick.settings().field.halfWidth();
  const std::array<Point, 4> corners{{{-x, y}, {x, y}, {-x, -y}, {x, -y}}};
  CounterRandom random = randomOf(tick, index, NoiseStream::Landmarks);
  std::array<double, 4> bearings{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bearings[i] = unseenLandmark;
    // Whether it is seen is drawn first: most are not, and directions cost more than draws.
    if (noise.landmarkProbability < 1.0 && random.uniform() >= noise.landmarkProbability) continue;
    const Polar seen = image.fromLens(corners[i]);
    if (std::abs(seen.bearing) >= landmarkHalfView) continue;
    const Polar corner = image.reported(corners[i], seen, 0.0);
    bearings[i] = degreesFromRadians(random.normal(corner.bearing, noise.landmarkBearing));
  }
  percept.bearingsDeg = bearings;
}

void unseenLandmarks(const RobotCommand& command, LandmarkPercept& percept) {
  if (command.localizationLook == lookForCorners) {
    percept.bearingsDeg = {unseenLandmark, unseenLandmark, unseenLandmark, unseenLandmark};
  } else if (command.localizationLook == lookForBallAsLandmark) {
    percept.ballTiltDeg = unseenBall;
    percept.ballPanDeg = unseenBall;
  }
}

bool ballAsLandmarkIsNoisy(const NoiseParameters& noise) {
  return noise.visionDistance != 0.0 || noise.visionBearing != 0.0;
}

/// The published VISION_TILT_DEG: the ball's distance as landmark vision sees it, with the whole
/// front of the body as its view.
void lookAtBallAsLandmark(const Tick& tick, std::size_t index, Image& image,
                          LandmarkPercept& percept) {
  const NoiseParameters& noise = tick.noise(index);
  const Polar& seen = image.ballFromLens();
  if (std::abs(seen.bearing) >= landmarkHalfView) {
    percept.ballTiltDeg = unseenBall;
    percept.ballPanDeg = unseenBall;
    return;
  }
  Polar ball = image.reported(image.ball(), seen, tick.settings().field.ballRadius);
  if (ballAsLandmarkIsNoisy(noise)) {
    if (!std::exchange(tick.batches.ballAsLandmarkDrawn, true)) {
      tick.draw(tick.batches.ballAsLandmark, ballAsLandmarkIsNoisy);
    }
    RandomBatch::Sequence random = tick.batches.ballAsLandmark.of(index);
    ball.distance = random.normal(ball.distance, noise.visionDistance * ball.distance);
    ball.bearing = random.normal(ball.bearing, noise.visionBearing);
  }
  percept.ballTiltDeg = published_frame::cmFromMetres(std::max(0.0, ball.distance));
  percept.ballPanDeg = degreesFromRadians(ball.bearing);
}

}  // namespace

std::size_t delayTicks(const WorldState& world, std::size_t index) {
  const SimulationSettings& settings = world.settings;
  const NoiseParameters& noise =
      settings.noise.ofModel ? world.models[index].noise : settings.noise;
  if (noise.visionDelay == 0.0) return 0;
  return static_cast<std::size_t>(std::lround(noise.visionDelay * settings.tickRate));
}

void drawSight(Tick& tick, std::span<const RandomBatch::Tick> ahead) {
  tick.draw(tick.batches.ball, ballVisionIsNoisy, ahead);
  tick.draw(tick.batches.ballAsLandmark, ballAsLandmarkIsNoisy, ahead);
}

std::size_t maxDelay(const WorldState& world) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < world.models.size(); ++i) {
    longest = std::max(longest, delayTicks(world, i));
  }
  return longest;
}

void stepVision(Tick& tick, std::size_t index, const RobotCommand& command, Percepts& percept) {
  RigidRobot& robot = tick.state.robots[index];
  if (!isDown(robot) && command.searchOn == 1) search(tick, index, robot);
  Image image(tick, index);
  if (isDown(robot) || !image.taken()) {
    unseenLandmarks(command, percept.landmarks);
    if (command.actionVision == lookForBall) percept.ball.lost = 1;
    return;
  }
  if (command.localizationLook == lookForCorners) {
    lookAtCorners(tick, index, image, percept.landmarks);
  } else if (command.localizationLook == lookForBallAsLandmark) {
    lookAtBallAsLandmark(tick, index, image, percept.landmarks);
  }
  if (command.actionVision == lookForBall) {
    publishBall(tick, index, image, command, percept);
  } else if (command.actionVision == lookForTeamMates) {
    lookAtRobots(tick, index, image, true, percept);
  } else if (command.actionVision == lookForOpponents) {
    lookAtRobots(tick, index, image, false, percept);
  }
}

void remember(Tick& tick) {
  RigidBodyState& state = tick.state;
  if (state.past.empty()) return;
  PastMoment& moment = state.past[tick.world.tick % state.past.size()];
  moment.ball = state.ball.position;
  for (std::size_t i = 0; i < state.robots.size(); ++i) {
    const RigidRobot& robot = state.robots[i];
    moment.robots[i] = {true, isDown(robot), robot.pose, robot.headYaw};
  }
}

void resizePast(WorldState& world, RigidBodyState& state) {
  const std::size_t delay = maxDelay(world);
  auto& ring = state.past;
  const std::size_t before = ring.size();
  if (before != delay) {
    // Vision goes on with the images that it had last.
    std::vector<PastMoment> kept(delay);
    for (std::size_t ago = 1; ago <= std::min(delay, before) && ago <= world.tick; ++ago) {
      kept[(world.tick - ago) % delay] = std::move(ring[(world.tick - ago) % before]);
    }
    ring = std::move(kept);
  }
  for (PastMoment& moment : ring) moment.robots.resize(state.robots.size());
}

}  // namespace pitchboard::sim::rigid
