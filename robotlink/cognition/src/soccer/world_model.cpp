// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/world_model.h"

#include <cmath>
#include <numbers>

#include <base/angles.h>
#include <base/repeatable_math.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

namespace frame = sim::published_frame;

constexpr int lookForBall = 0, lookForOpponents = 2;
constexpr unsigned cyclesBetweenLooks = 8;  // one of them for opponents
constexpr double ballGain = 0.45;           // of a new sighting against the prediction
constexpr double ballJump = 0.5;            // m: farther from the prediction it has been kicked

}  // namespace

void WorldModel::update(Blackboard& board, const Clock& clock) {
  const double seconds = m_first ? 0.0 : std::clamp(clock.seconds - m_now, 0.0, 1.0);
  m_now = clock.seconds;
  m_first = false;
  m_referee = static_cast<Referee>(board.read(m_variables.comReferee));
  m_fallen = board.read(m_variables.imuState) != 0;
  const int setPlay = readOr(board, m_setPlayWord);
  const bool known = setPlay >= 0 && setPlay <= static_cast<int>(lastOf(sim::SetPlay{}));
  m_setPlay = known ? static_cast<sim::SetPlay>(setPlay) : sim::SetPlay::None;
  m_setPlayOurs = readOr(board, m_setPlayOursWord) != 0;

  const Pose onField = frame::studioFromLocalization(
      m_field, {static_cast<double>(board.read(m_variables.localizationX)),
                static_cast<double>(board.read(m_variables.localizationY)),
                static_cast<double>(board.read(m_variables.localizationTheta))});
  m_imuYaw = static_cast<double>(board.read(m_variables.imuEulerZ));
  if (!std::isfinite(m_imuYaw)) m_imuYaw = 0.0;
  const double sigma = static_cast<double>(board.read(m_variables.localizationBelief));
  // Fresh memory holds zeros, and no filter is that sure.
  m_sigma = std::isfinite(sigma) && sigma > 0.0 ? frame::metresFromCm(sigma) : 1e9;
  findSide(onField.yaw);
  m_pose = m_attacksLeft ? Pose{{-onField.position.x, -onField.position.y},
                                wrapToPi(onField.yaw + std::numbers::pi)}
                         : onField;
  moveWithBody(board, seconds);
  if (m_lookedForOpponents) {
    readRobots(board);
  } else {
    readBall(board);
  }
  readMates(board);

  m_lookedForOpponents = ++m_cycle % cyclesBetweenLooks == 0;
  if (m_lookedForOpponents) {
    for (const FloatVar distance : m_variables.robotDist) board.write(distance, 0.0F);
  }
  board.write(m_variables.decisionActionVision,
              m_lookedForOpponents ? lookForOpponents : lookForBall);
}

void WorldModel::findSide(double theta) {
  if (m_facesLeft) {
    m_attacksLeft = *m_facesLeft;
    return;
  }
  if (!localized()) return;
  constexpr double rate = 0.05, sure = 0.3;
  m_side += rate * (repeatable::cos(theta - m_imuYaw) - m_side);
  if (std::abs(m_side) > sure) m_attacksLeft = m_side < 0.0;
}

void WorldModel::moveWithBody(const Blackboard& board, double seconds) {
  const sim::GaitSpeed speed = sim::gaitSpeed(m_body, board.read(m_variables.controlAction),
                                              board.read(m_variables.decisionActionB));
  const double x = m_ballLocal.x - speed.forward * seconds;
  const double y = m_ballLocal.y - speed.left * seconds;
  const auto [s, c] = repeatable::sinCos(speed.turn * seconds);
  m_ballLocal = {c * x + s * y, c * y - s * x};
}

void WorldModel::readBall(const Blackboard& board) {
  if (board.read(m_variables.visionLost) != 0) return;
  const double distance =
      frame::metresFromCm(static_cast<double>(board.read(m_variables.visionBallDist)));
  const double bearing =
      radiansFromDegrees(static_cast<double>(board.read(m_variables.visionPanDeg)));
  if (!std::isfinite(distance) || !std::isfinite(bearing) || distance <= 0.0) return;
  const auto [s, c] = repeatable::sinCos(bearing);
  const Point seen{distance * c, distance * s};
  const Point change{seen.x - m_ballLocal.x, seen.y - m_ballLocal.y};
  const bool jump = length(change) > ballJump || !seesBall();
  const double gain = jump ? 1.0 : ballGain;
  m_ballLocal = {m_ballLocal.x + gain * change.x, m_ballLocal.y + gain * change.y};
  m_ballSeen = m_now;
  m_ballField = toField(m_ballLocal);
  if (localized()) m_track.see(toField(seen), distance, m_now);
}

void WorldModel::readRobots(Blackboard& board) {
  for (std::size_t i = 0; i < m_opponents.size(); ++i) {
    const double distance =
        frame::metresFromCm(static_cast<double>(board.read(m_variables.robotDist[i])));
    // Right positive: the published sign of this variable.
    const double bearing =
        -radiansFromDegrees(static_cast<double>(board.read(m_variables.robotAngle[i])));
    if (!(distance > 0.0) || !std::isfinite(distance) || !std::isfinite(bearing)) continue;
    const auto [s, c] = repeatable::sinCos(bearing);
    m_opponents[i] = {toField({distance * c, distance * s}), m_now};
  }
}

Point WorldModel::fromCm(double x_cm, double y_cm) const {
  const Point p = frame::studioFromLocalization(m_field, {x_cm, y_cm, 0.0}).position;
  return m_attacksLeft ? Point{-p.x, -p.y} : p;
}

void WorldModel::readMates(const Blackboard& board) {
  for (std::size_t i = 0; i < m_mates.size(); ++i) {
    m_mates[i].reset();
    const auto state = static_cast<MateState>(readOr(board, m_team.state[i]));
    const auto place = unpackPlace(readOr(board, m_team.place[i], -1));
    if (state == MateState::Unknown || !place) continue;
    TeamMate mate;
    mate.position = fromCm(place->x, place->y);
    mate.intention = static_cast<Intention>(readOr(board, m_team.action[i]));
    mate.active = state == MateState::Active;
    if (const auto ball = unpackPlace(readOr(board, m_team.ball[i], -1))) {
      mate.ball = fromCm(ball->x, ball->y);
    }
    m_mates[i] = mate;
  }
  m_matePlaces.clear();
  for (std::size_t i = 0; i < m_team.mateX.size(); ++i) {
    const auto x = static_cast<double>(readOr(board, m_team.mateX[i], -1.0F));
    const auto y = static_cast<double>(readOr(board, m_team.mateY[i], -1.0F));
    // Zeros are fresh memory: nobody stands on the corner.
    if (x >= 0.0 && y >= 0.0 && x + y > 0.0) m_matePlaces.push_back(fromCm(x, y));
  }
}

double WorldModel::ballDistance() const {
  return length(m_ballLocal);
}
double WorldModel::ballBearing() const {
  return direction({}, m_ballLocal);
}

std::optional<Point> WorldModel::ball() const {
  if (seesBall()) return toField(m_ballLocal);
  // The nearest team-mate that sees it knows best.
  std::optional<Point> told;
  double nearest = 1e9;
  for (const auto& mate : m_mates) {
    if (!mate || !mate->ball) continue;
    const double d = distance(*mate->ball, mate->position);
    if (d < nearest) {
      nearest = d;
      told = mate->ball;
    }
  }
  if (told) return told;
  if (ballAge() < m_ballMemory) return m_ballField;
  return std::nullopt;
}

std::optional<Point> WorldModel::ballStops() const {
  if (!seesBall() || !localized()) return ball();
  return m_track.stopsAt(toField(m_ballLocal), m_field, m_now);
}

std::vector<Point> WorldModel::opponents() const {
  std::vector<Point> seen;
  for (const Sighting& sighting : m_opponents) {
    if (m_now - sighting.time < m_opponentMemory) seen.push_back(sighting.position);
  }
  return seen;
}

Pose WorldModel::toStudio(const Pose& turned) const {
  return {toStudio(turned.position),
          m_attacksLeft ? wrapToPi(turned.yaw + std::numbers::pi) : turned.yaw};
}

Point WorldModel::toField(const Point& p) const {
  const auto [s, c] = repeatable::sinCos(m_pose.yaw);
  return {m_pose.position.x + c * p.x - s * p.y, m_pose.position.y + s * p.x + c * p.y};
}

void WorldModel::tell(Blackboard& board, Intention intention,
                      const std::optional<Point>& target) const {
  const auto toCm = [this](const Point& p) {
    return frame::localizationFromStudio(m_field, {toStudio(p), 0.0});
  };
  writeIfPresent(board, m_team.intention, static_cast<int>(intention));
  const bool known = seesBall() && localized();
  const frame::CmPose ball = known ? toCm(toField(m_ballLocal)) : frame::CmPose{-1.0, -1.0, 0.0};
  writeIfPresent(board, m_team.ballX, static_cast<float>(ball.x));
  writeIfPresent(board, m_team.ballY, static_cast<float>(ball.y));
  const std::vector<Point> seen = localized() ? opponents() : std::vector<Point>();
  for (std::size_t i = 0; i < m_team.opponentX.size(); ++i) {
    const bool there = i < seen.size();
    const frame::CmPose at = there ? toCm(seen[i]) : frame::CmPose{-1.0, -1.0, 0.0};
    writeIfPresent(board, m_team.opponentX[i], static_cast<float>(at.x));
    writeIfPresent(board, m_team.opponentY[i], static_cast<float>(at.y));
  }
  if (!target) return;
  const frame::CmPose place = toCm(*target);
  writeIfPresent(board, m_team.targetX, static_cast<int>(std::lround(place.x)));
  writeIfPresent(board, m_team.targetY, static_cast<int>(std::lround(place.y)));
}

}  // namespace pitchboard::link
